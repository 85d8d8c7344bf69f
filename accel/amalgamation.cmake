# SPDX-License-Identifier: Apache-2.0
# The target `amalgamation`: the library as accel.c and accel.h in the build's folder amalgamation/.
find_package(Python3 COMPONENTS Interpreter QUIET)
if(NOT Python3_FOUND)
    return()
endif()
set(amalgamation ${CMAKE_BINARY_DIR}/amalgamation)
set(kinds_file src/kinds/kinds.h)
if(ACCEL_KINDS)
    set(kinds_file ${CMAKE_CURRENT_BINARY_DIR}/kinds.h)
endif()
file(GLOB headers CONFIGURE_DEPENDS src/*/*.h)
add_custom_command(OUTPUT ${amalgamation}/accel.c ${amalgamation}/accel.h
    COMMAND Python3::Interpreter amalgamate.py ${amalgamation} ${sources} --kinds ${kinds_file}
    DEPENDS amalgamate.py ${sources} ${headers} include/accel/accel.h
    WORKING_DIRECTORY ${CMAKE_CURRENT_SOURCE_DIR} VERBATIM)
add_custom_target(amalgamation DEPENDS ${amalgamation}/accel.c ${amalgamation}/accel.h)
