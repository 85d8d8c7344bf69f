#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# Every symbol that a program gets to see of the library begins with accel_: no name of its own
# clashes with one of ours, or is taken for it.
#
#     symbols.sh libaccel.a [libaccel.so]
set -euo pipefail
failed=0

# check LIBRARY LEAST NM-OPTION...
check() {
    local library=$1 least=$2 symbols others
    shift 2
    symbols=$(nm --defined-only "$@" "$library" | awk 'NF == 3 && $2 != "a" { print $3 }' | sort -u)
    others=$(grep -v '^accel_' <<<"$symbols" || true)
    if [ -n "$others" ]; then
        printf 'FAIL: %s defines %s\n' "$library" "$(tr '\n' ' ' <<<"$others")"
        failed=1
    fi
    [ "$(wc -l <<<"$symbols")" -ge "$least" ] || { echo "FAIL: $library defines too little" && failed=1; }
    printf '%s: %d symbols\n' "$library" "$(wc -l <<<"$symbols")"
}

check "$1" 20 --extern-only
[ $# -lt 2 ] || check "$2" 10 --dynamic --extern-only
exit $failed
