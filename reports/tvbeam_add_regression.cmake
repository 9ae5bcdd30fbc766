# Holds scenes against their [expect] blocks, or against a recorded baseline, as a test of the calling project.
#
#   tvbeam_add_regression(NAME name SCENE scene…      # shipped names or files; relative to the calling CMakeLists.txt
#                         [SHORT]                     # with the scenes' [short] blocks
#                         [SET key=value…]            # overrides
#                         [BASELINE file]             # recorded with `tvbeam check SCENE --record file`, likewise relative
#                         [TOLERANCE t]               # relative, for the baseline
#                         [JUNIT file])               # JUnit XML, relative to the build directory
function(tvbeam_add_regression)
    # Of the arguments as they were given: a value may hold semicolons, or be called OFF.
    cmake_parse_arguments(PARSE_ARGV 0 arg "SHORT" "NAME;BASELINE;TOLERANCE;JUNIT" "SCENE;SET")
    foreach(key IN ITEMS NAME BASELINE TOLERANCE JUNIT SCENE SET)
        if(key IN_LIST ARGV AND "${arg_${key}}" STREQUAL "")
            message(FATAL_ERROR "tvbeam_add_regression: no value for ${key}")
        endif()
    endforeach()
    if(NOT DEFINED arg_NAME OR NOT DEFINED arg_SCENE)
        message(FATAL_ERROR "tvbeam_add_regression needs NAME and SCENE")
    endif()
    if(DEFINED arg_UNPARSED_ARGUMENTS)
        message(FATAL_ERROR "tvbeam_add_regression does not know: ${arg_UNPARSED_ARGUMENTS}")
    endif()
    set(options)
    if(arg_SHORT)
        list(APPEND options --short)
    endif()
    foreach(assignment IN LISTS arg_SET)
        string(REPLACE ";" "\\;" assignment "${assignment}")
        list(APPEND options --set "${assignment}")
    endforeach()
    if(DEFINED arg_BASELINE)
        cmake_path(ABSOLUTE_PATH arg_BASELINE BASE_DIRECTORY ${CMAKE_CURRENT_SOURCE_DIR})
        if(NOT EXISTS "${arg_BASELINE}")
            list(JOIN arg_SCENE " " scenes)
            list(JOIN options " " given)
            message(FATAL_ERROR "tvbeam_add_regression: there is no baseline ${arg_BASELINE}; record it with\n"
                "  tvbeam check ${scenes} ${given} --record ${arg_BASELINE}")
        endif()
        list(APPEND options --baseline "${arg_BASELINE}")
    endif()
    if(DEFINED arg_TOLERANCE)
        list(APPEND options --tolerance "${arg_TOLERANCE}")
    endif()
    if(DEFINED arg_JUNIT)
        cmake_path(ABSOLUTE_PATH arg_JUNIT BASE_DIRECTORY ${CMAKE_CURRENT_BINARY_DIR})
        cmake_path(GET arg_JUNIT PARENT_PATH folder)
        file(MAKE_DIRECTORY "${folder}")
        list(APPEND options --junit "${arg_JUNIT}")
    endif()
    add_test(NAME "${arg_NAME}"
        COMMAND tvbeam::tvbeam check ${arg_SCENE} ${options}
        WORKING_DIRECTORY ${CMAKE_CURRENT_SOURCE_DIR})
endfunction()
