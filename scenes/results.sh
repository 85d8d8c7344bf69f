#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# Measures what scenes/RESULTS.md shows, and writes it anew: each section is a command and what it
# printed. Nothing in that page is typed by hand.
set -euo pipefail
# shellcheck source=scenes/prepare.sh
. "$(dirname "${BASH_SOURCE[0]}")/prepare.sh"

usage() {
    cat <<'HELP'
usage: scenes/results.sh [--quick] [-o FILE]
Runs every measurement of the page of results, about half an hour on a machine that does nothing
else, and then replaces FILE (default: scenes/RESULTS.md).
  --quick  the same sections from fewer rays and sizes, for a look: five minutes; no figures to quote
HELP
}

quick=0 page=$root/scenes/RESULTS.md
while [ $# -gt 0 ]; do
    case $1 in
    --help | -h) usage && exit 0 ;;
    --quick) quick=1 ;;
    -o) [ $# -gt 1 ] || bad_usage "-o needs a FILE" ;;&
    -o) page=$2 && shift ;;
    *) bad_usage "$1: not an option" ;;
    esac
    shift
done
[ ! -d "$page" ] || bad_usage "-o $page: a folder"

prepare tests
build_povray || die "the patched POV-Ray cannot be built"
"$root/scenes/fetch.sh" museum
"$root/scenes/fetch.sh" dragon
draft=$build/RESULTS.md

# section TITLE COMMAND...: runs it in the top folder and adds what it prints.
section() {
    local title=$1 out=$build/results.out
    shift
    (cd "$root" && step "$title" "$@") || exit 1
    cp "$logs/$(printf '%s' "$title" | tr -cs 'a-zA-Z0-9' '-').log" "$out"
    { printf '\n## %s\n\n    %s\n\n```\n' "$title" "$*" && tr -d '\r' <"$out" && printf '```\n'; } >>"$draft"
}

rays=(-n 50000 --repeats 5) lazy=(-n 1000000 --repeats 3) runs=3 clusters=()
[ $quick = 0 ] || { rays=(-n 3000 --repeats 2) && lazy=(-n 10000 --repeats 1) && runs=1 && clusters=(-n 100000); }
dragon=build/scenes/dragon.ply
{
    printf '# Results\n\nWritten by `scenes/results.sh%s`: each section is a command and what it printed. ' \
        "$([ $quick = 0 ] || echo ' --quick')"
    printf 'Times are of this machine, and only to be compared within a section.\n'
} >"$draft"
section "Structures and Embree, ray for ray" build/accel bench teapots cubes:gap=1 cubes:gap=100 \
    soup:n=300000 stadium $dragon --peers "${rays[@]}"
section "With AVX2, and with plain C" build/accel bench teapots $dragon spheres:n=8000 \
    -a bvh -a bvh:isa=avx2 -a bvh:isa=portable --peers "${rays[@]}"
section "Spheres" build/accel bench spheres:n=1000 spheres:n=8000 spheres:n=400000 "${rays[@]}"
section "The choice of auto" build/accel bench -n 3000 --repeats 5 --judged 20 "${choice_scenes[@]}"
section "Built where rays go" build/accel lazy stadium teapots $dragon "${lazy[@]}"
section "Finding clusters" build/accel clusters "${clusters[@]}"
section "Whole renders by POV-Ray" scenes/times.sh $runs hoo bsp bvh auto
mv "$draft" "$page"
say "written: $page"
