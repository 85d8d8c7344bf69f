#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# A stranger compiles the sources without CMake: with contraction the library refuses to build a
# structure, without it the answers keep their bits.
#
#     by_hand.sh HOST COMPILER
# shellcheck source=tests/foreign/common.sh
. "$(dirname "${BASH_SOURCE[0]}")/common.sh"
compiler=$2
root=$here/../..

# compile FLAG...
compile() {
    quietly "$compiler $*" "$compiler" -O3 -march=native -Wall -Wextra -Wpedantic -Werror "$@" \
        "-I$root/accel/include" "$here/host.c" "$root"/accel/src/*/*.c \
        -o "$work/host" -lm -lpthread
}

compile -ffp-contract=fast
if grep -q __FMA__ <<<"$("$compiler" -march=native -dM -E -x c /dev/null)"; then
    if "$work/host" >"$work/out" 2>"$work/err"; then
        fail "a library with contraction builds structures"
    fi
    if [ "$(wc -l <"$work/err")" != 1 ] || ! grep -q -e '-ffp-contract=off' "$work/err"; then
        fail "a library with contraction says '$(head -c 600 "$work/err")'"
    fi
    echo "with contraction: refused"
else
    same_answers "without instructions for contraction" "$work/host"
fi
compile -ffp-contract=off
same_answers "$compiler without contraction" "$work/host"
