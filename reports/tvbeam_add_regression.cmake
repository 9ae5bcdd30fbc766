# Holds scenes against their [expect] blocks, or against a recorded baseline, as a test of the calling project.
#
#   tvbeam_add_regression(NAME name SCENE scene…      # shipped names or files; relative to the calling CMakeLists.txt
#                         [SHORT]                     # with the scenes' [short] blocks
#                         [SET key=value…]            # overrides
#                         [BASELINE file]             # recorded with `tvbeam check SCENE --record file`
#                         [TOLERANCE t]               # relative, for the baseline
#                         [JUNIT file])               # JUnit XML, relative to the build directory
function(tvbeam_add_regression)
    cmake_parse_arguments(arg "SHORT" "NAME;BASELINE;TOLERANCE;JUNIT" "SCENE;SET" ${ARGN})
    if(NOT arg_NAME OR NOT arg_SCENE)
        message(FATAL_ERROR "tvbeam_add_regression needs NAME and SCENE")
    endif()
    if(arg_KEYWORDS_MISSING_VALUES)
        message(FATAL_ERROR "tvbeam_add_regression: no value for ${arg_KEYWORDS_MISSING_VALUES}")
    endif()
    if(arg_UNPARSED_ARGUMENTS)
        message(FATAL_ERROR "tvbeam_add_regression does not know: ${arg_UNPARSED_ARGUMENTS}")
    endif()
    set(options)
    if(arg_SHORT)
        list(APPEND options --short)
    endif()
    foreach(assignment IN LISTS arg_SET)
        list(APPEND options --set ${assignment})
    endforeach()
    if(arg_BASELINE)
        list(APPEND options --baseline ${arg_BASELINE})
    endif()
    if(DEFINED arg_TOLERANCE)
        list(APPEND options --tolerance ${arg_TOLERANCE})
    endif()
    if(arg_JUNIT)
        list(APPEND options --junit ${CMAKE_CURRENT_BINARY_DIR}/${arg_JUNIT})
    endif()
    add_test(NAME ${arg_NAME}
        COMMAND tvbeam::tvbeam check ${arg_SCENE} ${options}
        WORKING_DIRECTORY ${CMAKE_CURRENT_SOURCE_DIR})
endfunction()
