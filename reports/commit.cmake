# Writes OUTPUT, a header with the commit that SOURCE stands at; "unknown" where it is no checkout of its own.
cmake_minimum_required(VERSION 3.25)
execute_process(
    COMMAND git --git-dir=${SOURCE}/.git --work-tree=${SOURCE} describe --always --dirty --abbrev=12 --exclude=*
    OUTPUT_VARIABLE commit OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET RESULT_VARIABLE failed)
if(failed)
    set(commit unknown)
endif()
file(CONFIGURE OUTPUT ${OUTPUT} CONTENT "#define TVBEAM_COMMIT \"@commit@\"\n" @ONLY)
