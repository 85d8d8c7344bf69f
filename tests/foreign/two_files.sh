#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# A stranger takes the library as two files: hosts in C and C++, gcc and clang get the same bits, no
# name but accel_... is defined, and with contraction the library refuses.
#
#     two_files.sh HOST FOLDER     FOLDER: where accel.c and accel.h are
# shellcheck source=tests/foreign/common.sh
. "$(dirname "${BASH_SOURCE[0]}")/common.sh"
folder=$2

# try C-COMPILER C++-COMPILER
try() {
    quietly "$1: accel.c" "$1" -std=c11 -O2 -march=native -ffp-contract=off -Wall -Wextra -Wpedantic -Werror \
        -fvisibility=hidden -c "$folder/accel.c" -o "$work/accel.o"
    "$here/symbols.sh" "$work/accel.o" || fail "$1: symbols"
    quietly "$1: a host in C" "$1" "-I$work" "$here/host.c" "$work/accel.o" -o "$work/host" -lm -lpthread
    same_answers "$1" "$work/host"
    quietly "$2: a host in C++" "$2" "-I$work" "$here/host.cpp" "$work/accel.o" -o "$work/host" -lm -lpthread
    same_answers "$2" "$work/host"
}

mkdir "$work/accel"
cp "$folder/accel.h" "$work/accel/"
try gcc g++
try clang clang++
