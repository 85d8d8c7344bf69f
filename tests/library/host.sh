#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# usage: host.sh INCLUDE... Compiles host.c as C and C++ with gcc and clang, where no warning is
# allowed. What includes the header is no system header, or its warnings would not show.
set -euo pipefail
host=$(dirname "${BASH_SOURCE[0]}")/host.c
object=$(mktemp)
trap 'rm -f "$object"' EXIT
failed=0
for compiler in 'gcc -std=c11' 'gcc -std=gnu17' 'g++ -x c++ -std=c++11' 'g++ -x c++ -std=c++20' \
    'clang -std=c11' 'clang -std=gnu17' 'clang++ -x c++ -std=c++11' 'clang++ -x c++ -std=c++20'; do
    for level in -O0 -O2 -O3; do
        # shellcheck disable=SC2086 # words
        $compiler "$level" -Wall -Wextra -Werror "${@/#/-I}" -c "$host" -o "$object" ||
            { failed=1 && echo "$compiler $level complains"; }
    done
done
exit "$failed"
