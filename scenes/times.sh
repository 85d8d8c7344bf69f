#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# Times of stock POV-Ray's bounding (+BM1, +BM2) and of every kind, in turn, in one run.
#
# Times are CPU seconds of tracing, of photons and of radiosity together, as POV-Ray's statistics
# state them, with one thread for all but the photons; medians. The ratio is that of stock's better
# method over ours, so below 1 ours is slower. Needs what scenes/demo.sh builds; Tango comes
# from Debian's povray-examples.
set -euo pipefail
# shellcheck source=scenes/prepare.sh
. "$(dirname "${BASH_SOURCE[0]}")/prepare.sh"

if [ "${1:-}" = --help ] || [ "${1:-}" = -h ]; then
    say "usage: scenes/times.sh [--illumination] [RUNS [CONFIG]...]"
    say "default: 5 hoo octree hug grid bsp bvh auto; the scenes are clustered and Tango, with"
    say "--illumination the paper's two with POV-Ray's own photons and radiosity"
    exit 0
fi
illumination=0
[ "${1:-}" != --illumination ] || { illumination=1 && shift; }
runs=${1:-5}
[[ $runs =~ ^[1-9][0-9]?$ ]] || {
    echo "times.sh: '$runs' runs; allowed are 1 to 99; --help explains" >&2
    exit 2
}
shift || true
configs=("$@")
[ $# -gt 0 ] || configs=(hoo octree hug grid bsp bvh auto)
[ -x "$build/povray-accel" ] || die "no build/povray-accel; ./scenes/demo.sh builds it"
install_missing povray povray-includes povray-examples
check_configs "${configs[@]}"
times=$build/times
need_folder "$times"

# trace SCENE NAME COMMAND...: renders, and adds the CPU seconds to the scene's list.
trace() {
    local list=$times/$1.$2 log=$times/log
    shift 2
    (cd "$root" && "$@" -D -A -F +WT1 </dev/null >"$log" 2>&1) || die "$* failed; see build/times/log"
    tr '\r' '\n' <"$log" | awk '/ Time:/ { on = /(Photon|Radiosity|Trace) Time:/ } on && /CPU-seconds/ { s += $5 }
        END { print s }' >>"$list"
}

# turns SCENE ARGUMENT...: the scene with every contender, `runs` times in turn.
turns() {
    local scene=$1 run config
    shift
    rm -f "$times/$scene".*
    for run in $(seq "$runs"); do
        say "  $scene: run $run of $runs"
        trace "$scene" +BM1 povray "$@" +BM1
        trace "$scene" +BM2 povray "$@" +BM2
        for config in "${configs[@]}"; do
            trace "$scene" "$config" build/povray-accel "$@" Bounding_Method=3 Accelerator="$config"
        done
    done
}

table() {
    local scene=$1 stock1 stock2 config
    stock1=$(median <"$times/$scene.+BM1") stock2=$(median <"$times/$scene.+BM2")
    for config in "${configs[@]}"; do
        awk -v scene="$scene" -v kind="$config" -v a="$stock1" -v b="$stock2" \
            -v ours="$(median <"$times/$scene.$config")" 'BEGIN {
                printf "%-18s %-10s %8.3f %8.3f %8.3f %7.2f\n", scene, kind, a, b, ours,
                    (a < b ? a : b) / ours }'
    done
}

rows=()

# measure SCENE ARGUMENT...
measure() {
    turns "$@"
    rows+=("$1")
}

if [ "$illumination" -eq 0 ]; then
    examples=/usr/share/doc/povray/examples
    measure clustered scenes/clustered.ini +W320 +H180
    measure Tango "+I$examples/bsp/Tango.pov" "+L$examples/bsp" \
        +L/usr/share/povray-3.7/include +W160 +H120
else
    for scene in cubes teapots; do
        measure "$scene-photons" "scenes/$scene.ini" +W320 +H180 Declare=Photons=20000
        measure "$scene-radiosity" "scenes/$scene.ini" +W320 +H180 Declare=Radiosity=50
    done
fi
say
printf '%-18s %-10s %8s %8s %8s %7s\n' scene kind "+BM1 s" "+BM2 s" "ours s" ratio
for row in "${rows[@]}"; do
    table "$row"
done
