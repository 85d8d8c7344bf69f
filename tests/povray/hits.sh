#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# Do the hits of accel trace agree with those of stock POV-Ray's trace()?
#
# hits.pov traces rays with trace() and writes them down with its hits; accel trace --rays traces
# the same rays through the same triangles; compare_hits.awk says when they agree.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
# shellcheck source=tests/povray/common.sh
. "$here/common.sh"

usage() {
    cat <<'HELP'
usage: tests/povray/hits.sh SCENE [COLUMNSxROWS [CONFIG]]
  SCENE         cubes (gap=8), far-cubes (gap=100), teapots; bunny, camel and dragon, which
                scenes/fetch.sh brings
  COLUMNSxROWS  rays from the camera; each hit sends one more (default: 96x64)
  CONFIG        structure (default: the command's)
Needs build/accel and povray. Works in build/tests/hits-SCENE.
HELP
}

fail() {
    printf 'hits.sh: %s\n' "$*" >&2
    exit 2
}

# choose SCENE: sets scene (accel's name) and the camera: eye, at, fov.
choose() {
    case $1 in
    cubes) scene=cubes:gap=8 eye=(-17.3 17.1 -18.2) at=(20.1 5.4 6.3) fov=66 ;;
    far-cubes) scene=cubes:gap=100 eye=(-31.7 12.9 -3.3) at=(700.2 8.1 4.9) fov=50 ;;
    teapots) scene=teapots eye=(-9.7 11.3 -17.9) at=(-0.9 0.4 -0.6) fov=57 ;;
    bunny) scene=$build/scenes/bunny.off eye=(0.31 0.62 2.03) at=(0.01 -0.02 0.03) fov=35 ;;
    camel) scene=$build/scenes/camel.off eye=(1.71 0.53 0.92) at=(0.01 -0.02 0.03) fov=38 ;;
    dragon) scene=$build/scenes/dragon.ply eye=(-0.12 0.25 0.42) at=(-0.006 0.118 0.003) fov=34 ;;
    *) usage >&2 && fail "$1: not a scene" ;;
    esac
}

# Geometry for POV-Ray; sets form (hits.pov's Scene) and total.
provide_geometry() {
    case $1 in
    cubes) form=0 gap=8 total=12288 ;;
    far-cubes) form=0 gap=100 total=12288 ;;
    *)
        form=1 gap=0
        "$build/accel" export "$scene" --as triangles -o "$work/triangles.inc" --quiet
        total=$(grep -c '^{' "$work/triangles.inc")
        ;;
    esac
}

trace_with_povray() {
    (cd "$work" && povray "$here/hits.pov" +L"$root/scenes" -D -F +W1 +H1 \
        Declare=Scene="$form" Declare=Gap="$gap" Declare=Total="$total" \
        Declare=Eye_X="${eye[0]}" Declare=Eye_Y="${eye[1]}" Declare=Eye_Z="${eye[2]}" \
        Declare=At_X="${at[0]}" Declare=At_Y="${at[1]}" Declare=At_Z="${at[2]}" \
        Declare=Fov="$fov" Declare=Columns="$columns" Declare=Rows="$rows" \
        </dev/null >"$work/povray.log" 2>&1) ||
        { tail -n 5 "$work/povray.log" >&2 && fail "povray failed: $work/povray.log"; }
    ! grep -q 'Degenerate' "$work/povray.log" || fail "POV-Ray left out triangles: $work/povray.log"
}

# Number of the first triangle of each geometry, from the export's or the cubes' order.
first_of_geometry() {
    if [ "$form" -eq 0 ]; then
        echo "0 0"
    else
        awk -F '[{,}]' '/^#declare First/ { for (i = 2; i < NF - 1; i++) print i - 2, $i }' \
            "$work/triangles.inc"
    fi
}

compare() {
    paste -d ' ' <(sed 's/$/ |/' "$work/rays.txt") <(sed 's/$/ |/' "$work/hits.txt") \
        "$work/accel.txt" >"$work/all.txt"
    awk -v name="$1" -f "$here/compare_hits.awk" <(first_of_geometry) "$work/all.txt"
}

if [ $# -lt 1 ] || [ $# -gt 3 ] || [ "$1" = --help ]; then
    usage
    exit 2
fi
[[ ${2:-96x64} =~ ^([1-9][0-9]*)x([1-9][0-9]*)$ ]] || fail "$2: not COLUMNSxROWS"
columns=${BASH_REMATCH[1]} rows=${BASH_REMATCH[2]}
choose "$1"
[[ $scene != */* ]] || need "$scene"
work=$build/tests/hits-$1
mkdir -p "$work"
provide_geometry "$1"
trace_with_povray
"$build/accel" trace "$scene" --rays "$work/rays.txt" -o "$work/accel.txt" --quiet ${3:+-a "$3"}
[ "$(wc -l <"$work/accel.txt")" -eq "$(wc -l <"$work/hits.txt")" ] || fail "$1: not a hit for each ray"
compare "$1"
