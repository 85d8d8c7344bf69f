#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
#
# Objects whose boxes are hard to know: cases/*.pov. Each is rendered with stock's linear search and
# with povray-accel, which compares every query with a linear search, and every hit with the box of
# its object. A case says what is right at 80x60:
#
#     // red: COUNT             pixels that are pure red
#     // unbounded: COUNT       objects without a box: no more than need be
#     // refused: COUNT         rays that are searched linearly, where it matters
#     // options: OPTION...     rendered with these; one line for each way to render
#
# A box that holds no hits shows as a difference or, where no ray of the picture proves it, as a hit
# outside; one that need not be infinite, by the count.
set -euo pipefail
# shellcheck source=tests/povray/common.sh
. "$(dirname "${BASH_SOURCE[0]}")/common.sh"

here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
size=80x60
kinds=(bvh bsp hoo)

# stated FILE NAME: what a case says of NAME, a line for each time
stated() {
    sed -n "s|^// $2: *||p" "$1"
}

red_pixels() {
    pixels "$1" "$size" | od -An -v -t x1 -w6 | grep -c 'ff ff 00 00 00 00' || true
}

# complain TEXT...: notes what is wrong with this case
complain() {
    echo "$name: $*" >>wrong
}

# check_render WHAT KIND OPTION...: compares a render with linear.ppm and with what the case says
check_render() {
    local what=$1 kind=$2 found
    shift 2
    render "$what.log" $size "$ours" +I"$file" +MB1 +BM3 Accelerator="$kind" +BV +O"$what.ppm" "$@" ||
        complain "$what: ends with exit code $?"
    found=$(different_pixels linear.ppm "$what.ppm" $size)
    [ "$found" -eq 0 ] || complain "$what: $found pixels differ from -MB"
    found=$(statistic "$what.log" '^Accelerator verified:' 5)
    [ "${found:-no}" = 0 ] || complain "$what: ${found:-no} queries differ"
    found=$(statistic "$what.log" '^Accelerator outside:' 3)
    [ "${found:-no}" = 0 ] || complain "$what: ${found:-no} hits outside their box"
    found=$(statistic "$what.log" '^  Objects:' 4)
    [ "${found:-no}" = "$unbounded" ] || complain "$what: ${found:-no} unbounded objects, not $unbounded"
    found=$(statistic "$what.log" '^Accelerator refused:' 3)
    [ "${refused:-${found:-0}}" = "${found:-0}" ] || complain "$what: ${found:-0} rays refused, not $refused"
}

# One case in a folder of its own.
run_case() {
    local file=$1 name unbounded refused red found options way=0 kind
    name=$(basename "$file" .pov)
    mkdir -p "$out/$name"
    cd "$out/$name"
    rm -f ./*
    unbounded=$(stated "$file" unbounded) refused=$(stated "$file" refused) red=$(stated "$file" red)
    while read -ra options; do
        way=$((way + 1))
        render linear.log $size "$stock" +I"$file" +MB1 -MB +Olinear.ppm "${options[@]}" ||
            complain "stock ends with exit code $?"
        found=$(red_pixels linear.ppm)
        [ "$found" = "$red" ] || complain "stock: $found red pixels, not $red (${options[*]})"
        for kind in "${kinds[@]}"; do check_render "$kind-$way" "$kind" "${options[@]}"; done
    done < <(stated "$file" options | grep . || echo)
    touch done
}

need_binaries
out=$build/tests/bounds
mkdir -p "$out"
cases=("$@")
[ ${#cases[@]} -gt 0 ] || cases=("$here"/cases/*.pov)
for file in "${cases[@]}"; do
    # POV-Ray waits for its own threads more than it computes
    while [ "$(jobs -rp | wc -l)" -ge $(($(nproc) * 2)) ]; do wait -n || true; done
    (run_case "$(realpath -e "$file")") &
done
wait
failed=0
for file in "${cases[@]}"; do
    name=$(basename "$file" .pov)
    if [ -e "$out/$name/done" ] && [ ! -s "$out/$name/wrong" ]; then
        printf 'ok      %s\n' "$name"
    else
        printf 'FAILED  %s\n' "$name"
        sed 's/^/  /' "$out/$name/wrong" 2>/dev/null || true
        failed=1
    fi
done
exit $failed
