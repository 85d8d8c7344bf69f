#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# Do library, command and tests pass where only some kinds are compiled (-DACCEL_KINDS=...)?
#
#     tests/subsets.sh [--all] [SUBSET]...     default: linear 'linear;hoo' 'linear;grid;bvh'
#
# Builds each subset in build/subset-*, with warnings as errors, and runs a few tests at small size;
# --all runs every test of library and command. ACCEL_TEST_INTENSITY scales their counts.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
export ACCEL_TEST_INTENSITY=${ACCEL_TEST_INTENSITY:-0.02}
usage="usage: tests/subsets.sh [--all] [SUBSET]..., for instance 'linear;hoo'"
all=0
case "${1:-}" in
-h | --help) echo "$usage" && exit 0 ;;
--all) all=1 && shift ;;
-*) echo "subsets.sh: $1 is no option; $usage" >&2 && exit 2 ;;
esac
[ $# -gt 0 ] || set -- linear 'linear;hoo' 'linear;grid;bvh'

fail() {
    printf 'subsets.sh: %s\n' "$*"
    exit 1
}

# expected SUBSET: the kinds that a library of it must have; linear and auto are always in.
expected() {
    tr ';' '\n' <<<"linear;$1;auto" | sort -u
}

for subset; do
    build=$root/build/subset-${subset//;/-}
    log=$build.log
    mkdir -p "$root/build"
    cmake -S "$root" -B "$build" -DCMAKE_BUILD_TYPE=Release -DACCEL_WERROR=ON \
        "-DACCEL_KINDS=$subset" >"$log" 2>&1 || { tail -n 20 "$log" && fail "cmake failed: $log"; }
    targets=(accel_command agree test_config_strings test_choice test_left_out test_box_edges)
    tests=(-R '^(config_strings|choice|left_out|box_edges|agree-(degenerate|surface-origins)|command-(usage|bench))$')
    if [ "$all" = 1 ]; then
        targets=(all)
        tests=(-L 'library|command')
    fi
    cmake --build "$build" --target "${targets[@]}" >"$log" 2>&1 ||
        { grep -A 5 -E 'error|warning' "$log" && fail "$subset does not compile: $log"; }
    kinds=$("$build/accel" kinds | awk '!NF { block++ } block == 1 && /^[a-z]/ { print $1 }' | sort)
    [ "$kinds" = "$(expected "$subset")" ] || fail "$subset: compiled are" $kinds
    grep -q linear <<<"$("$build/accel" info one --quiet)" || fail "$subset: the default config fails"
    ctest --test-dir "$build" --output-on-failure "${tests[@]}" >"$log" 2>&1 ||
        { grep -E 'tests passed|Failed|\*\*\*' "$log" && fail "$subset: tests fail: $log"; }
    printf '%s: %s\n' "$subset" "$(grep 'tests passed' "$log")"
done
