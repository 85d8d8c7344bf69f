# SPDX-License-Identifier: Apache-2.0
# Sets `sources`, the files to compile, and `definitions`, for the kinds in ACCEL_KINDS.
#
# A part's files are src/PART.c, src/PART_*.c and src/PART/*.c; files of no part are always compiled.
# A part may bear the name of a kind, such as octree, of which hoo is made too: src/octree.c itself is
# then only compiled for that kind.
set(kinds "")
set(parts "")
file(STRINGS src/kinds.h lines REGEX "^KIND\\(")
foreach(line IN LISTS lines)
    string(REGEX MATCHALL "[a-z]+" words "${line}")
    list(POP_FRONT words name)
    list(APPEND kinds ${name})
    list(APPEND parts ${words})
    set(parts_of_${name} ${words})
endforeach()

set(left "")
set(chosen ${ACCEL_KINDS})
list(REMOVE_ITEM chosen "")
foreach(name IN LISTS chosen)
    if(NOT name IN_LIST kinds)
        message(FATAL_ERROR "ACCEL_KINDS: unknown kind '${name}', allowed are ${kinds}")
    endif()
endforeach()

set(definitions "")
if(chosen)
    list(APPEND chosen linear auto)
    set(left ${kinds})
    list(REMOVE_ITEM left ${chosen})
    list(REMOVE_ITEM kinds "" ${left})
    list(TRANSFORM kinds REPLACE "(.+)" "KIND(\\1, \\1)\n" OUTPUT_VARIABLE lines)
    string(CONCAT lines "/* Made by accel/sources.cmake. */\n" ${lines})
    file(CONFIGURE OUTPUT kinds.h CONTENT "${lines}")
    set(definitions ACCEL_KINDS_FILE="${CMAKE_CURRENT_BINARY_DIR}/kinds.h")
endif()
set(needed "")
foreach(name IN LISTS kinds)
    list(APPEND needed ${parts_of_${name}})
endforeach()

file(GLOB sources RELATIVE ${CMAKE_CURRENT_SOURCE_DIR} CONFIGURE_DEPENDS src/*.c src/*/*.c)
foreach(source IN LISTS sources)
    string(REGEX MATCH "^src/([a-z]+)(_?)" match ${source})
    set(owner ${CMAKE_MATCH_1})
    if((owner IN_LIST parts AND NOT owner IN_LIST needed) OR
       (owner IN_LIST left AND NOT CMAKE_MATCH_2))
        list(REMOVE_ITEM sources ${source})
    endif()
endforeach()
