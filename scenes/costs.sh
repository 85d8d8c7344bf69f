#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# Measures what kinds cost, and prints the lines of accel/src/core/cost.h that fit.
set -euo pipefail
# shellcheck source=scenes/prepare.sh
. "$(dirname "${BASH_SOURCE[0]}")/prepare.sh"

usage() {
    cat <<'HELP'
usage: scenes/costs.sh [--quick] [--from FILE.csv]...
Runs `accel bench` over the scenes by which the choice of auto is judged, about a quarter of an hour on a
machine that does nothing else, and fits the costs of the kinds to its figures. Prints today's lines of
accel/src/core/cost.h and those that fit, with the root mean square of their relative errors; changes nothing.
Whether auto chooses better by them the section "The choice of auto" of scenes/results.sh tells.
  --from FILE.csv  fits figures of an earlier run, which lie in build/costs/, instead of measuring
  --quick          four scenes, few rays: for a look
HELP
}

figures=() rays=(-n 3000 --repeats 5 --judged 20) quick=0
# shellcheck disable=SC2054 # commas within options
small=(soup:n=1000 soup:min=0.1,n=3000 spheres:n=30 spheres:n=1000 nested:n=50 same:n=200)
while [ $# -gt 0 ]; do
    case $1 in
    --help | -h) usage && exit 0 ;;
    --quick) quick=1 ;;
    --from) [ $# -gt 1 ] || bad_usage "--from needs a FILE.csv" ;;&
    --from) [ -r "$2" ] || bad_usage "--from $2: no file to read" ;;&
    --from) figures+=("$(realpath "$2")") && shift ;;
    *) bad_usage "$1: not an option" ;;
    esac
    shift
done

if [ "${#figures[@]}" -eq 0 ]; then
    prepare fast
    kinds=()
    for kind in grid hug octree hoo bsp bvh; do
        "$build/accel" info one -a $kind --quiet >/dev/null 2>&1 && kinds+=(-a "$kind")
    done
    [ $quick = 0 ] || choice_scenes=(cubes:gap=1 teapots:quads=3 soup:n=1000 spheres:n=1000)
    # shellcheck disable=SC2054 # commas within options
    [ $quick = 0 ] || small=(soup:n=1000 spheres:n=30)
    [ $quick = 0 ] || rays=(-n 300 --repeats 2 --judged 20)
    [ $quick = 1 ] || "$root/scenes/fetch.sh" dragon
    need_folder "$build/costs"
    figures=("$build/costs/kinds.csv" "$build/costs/linear.csv")
    cd "$root"
    step "kinds" build/accel bench "${choice_scenes[@]}" "${kinds[@]}" "${rays[@]}" --csv "${figures[0]}"
    step "linear" build/accel bench "${small[@]}" -a linear -n 300 --repeats 3 --judged 20 --csv "${figures[1]}"
fi
exec awk -v seen="$root/accel/src/core/cost.h" -f "$root/scenes/costs.awk" "${figures[@]}"
