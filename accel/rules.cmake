# SPDX-License-Identifier: Apache-2.0
# How everything that computes is compiled, whatever the flags around it: included by the folders
# that hold it, for themselves and those below.
#
# Exactness rests on every operation being rounded on its own (accel/src/core/contract.h). -ffp-contract
# comes last: clang's -fno-fast-math undoes it.
set(CMAKE_C_STANDARD 11)
set(CMAKE_C_STANDARD_REQUIRED ON)
set(CMAKE_C_EXTENSIONS OFF)
set(CMAKE_CXX_STANDARD 14)

option(ACCEL_WERROR "warnings are errors" OFF)
add_compile_options(-fno-fast-math -ffp-contract=off -Wall -Wextra
                    $<$<COMPILE_LANGUAGE:C>:-Wconversion>)
if(ACCEL_WERROR)
    add_compile_options(-Werror)
endif()
