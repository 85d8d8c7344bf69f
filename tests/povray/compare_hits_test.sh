#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# Does compare_hits.awk see what it must see? Crafted hits, one of each sort.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
failed=0

# expect EXIT_CODE "SAME MISSED EDGE DIFFER" LINE...: geometry 1 starts at triangle 100.
expect() {
    local code=$1 counts=$2 got=0 text
    shift 2
    text=$(awk -v name=test -f "$here/compare_hits.awk" <(printf '0 0\n1 100\n') \
        <(printf '%s\n' "$@")) || got=$?
    text=$(sed -n 's/^test: [0-9]* rays: \([0-9]*\) hit the same triangle, \([0-9]*\) miss in both, \([0-9]*\) on an edge, \([0-9]*\) differ;.*/\1 \2 \3 \4/p' <<<"$text")
    if [ "$got" -ne "$code" ] || [ "$text" != "$counts" ]; then
        echo "expected exit $code and '$counts', got exit $got and '$text' for: $*"
        failed=1
    fi
}

ray="0 0 0 0 0 2 0 100"
good="$ray | 0 0 10 7 | 0 7 5 0.25 0.25"
expect 0 "1 0 0 0" "$good"
expect 0 "2 0 0 0" "$good" "$ray | 0 0 10 107 | 1 7 5 0.25 0.25"
expect 0 "1 1 0 0" "$good" "$ray | miss | miss"
expect 1 "0 1 0 0" "$ray | miss | miss"
expect 1 "1 0 0 1" "$good" "$ray | miss | 0 7 5 0.25 0.25"
expect 1 "1 0 0 1" "$good" "$ray | 0 0 10 7 | miss"
expect 1 "1 0 0 1" "$good" "$ray | 0 0 10 7 | 0 8 5 0.25 0.25"
expect 1 "1 0 0 1" "$good" "$ray | 0 0 10 7 | 1 7 5 0.25 0.25"
expect 0 "1 0 1 0" "$good" "$ray | 0 0 10 7 | 0 8 5 0 0.25"
expect 0 "1 0 1 0" "$good" "$ray | 0 0 10 7 | 0 8 5 0.75 0.25"
expect 1 "1 0 0 1" "$good" "$ray | 0 0 10 7 | 0 7 5.00000001 0.25 0.25"
expect 1 "1 0 0 1" "$good" "$ray | 0 0 10.00000002 7 | 0 7 5 0.25 0.25"
expect 1 "1 0 0 1" "$good" "$ray | 0 0 10 7 | 0 7 nan 0.25 0.25"
expect 1 "1 0 0 1" "$good" "$ray | 0 0 10 | 0 7 5 0.25 0.25"
exit "$failed"
