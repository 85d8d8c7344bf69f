# SPDX-License-Identifier: Apache-2.0
# Run by every build: writes the commit of SOURCE into HEADER, if that is not what it says already.
execute_process(COMMAND git -C ${SOURCE} describe --always --dirty
    OUTPUT_VARIABLE commit OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET RESULT_VARIABLE no_git)
if(no_git)
    set(commit "a tree without git")
endif()
file(CONFIGURE OUTPUT ${HEADER} CONTENT "#define ACCEL_COMMIT \"${commit}\"\n")
