#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# Do the hits of accel trace agree with those of stock POV-Ray's trace()?
#
# hits.pov traces rays with trace() and writes them down with its hits; accel trace --rays traces
# the same rays through the same triangles. A ray agrees if both miss, or if both hit the same
# triangle at distances that differ by less than 1e-9 of them. A hit of another triangle is told
# apart as "on an edge" if the distances agree as before and accel's hit lies on the border of its
# triangle (a weight below 1e-9): both triangles hold the point then. Everything else is a
# difference, is printed, and ends the test with 1.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
root=$(cd "$here/../.." && pwd)
build=$root/build

usage() {
    cat <<'HELP'
usage: tests/povray/hits.sh SCENE [COLUMNSxROWS [CONFIG]]
  SCENE         cubes (gap=8), far-cubes (gap=100), teapots, or one of the meshes that
                scenes/fetch.sh brings: bunny, camel, ...
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
        total=$(grep -c '^Triangle' "$work/triangles.inc")
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
        awk -F '[(,]' '/^Triangle/ && $2 != last { last = $2; print $2, n + 0 } /^Triangle/ { n++ }' \
            "$work/triangles.inc"
    fi
}

compare() {
    paste -d ' ' <(sed 's/$/ |/' "$work/rays.txt") <(sed 's/$/ |/' "$work/hits.txt") \
        "$work/accel.txt" >"$work/all.txt"
    awk -v name="$1" '
        function distance(x, y, z) { return sqrt(x * x + y * y + z * z) }
        function differ(why) { if (++different <= 10) print "  difference, " why ": " line }
        FNR == NR { first[$1] = $2; next }
        {
            line = $0
            split($0, part, " \\| *")
            split(part[1], ray, " "); pov = split(part[2], p, " "); ours = split(part[3], a, " ")
            rays++
            if (pov == 1 && ours == 1) { missed++; next }
            if (pov == 1 || ours == 1) { differ("one of both misses"); next }
            if (pov != 4 || ours != 5) { differ("not understood"); next }
            t = distance(p[1] - ray[1], p[2] - ray[2], p[3] - ray[3])
            t /= distance(ray[4], ray[5], ray[6])
            off = t > a[3] ? (t - a[3]) / a[3] : (a[3] - t) / a[3]
            if (off >= 1e-9) { differ("distances differ by " off); next }
            if (off > worst) worst = off
            number = first[a[1]] + a[2]
            if (p[4] > number - 0.01 && p[4] < number + 0.01) { same++; next }
            weight = 1 - a[4] - a[5]
            if (a[4] < weight) weight = a[4]
            if (a[5] < weight) weight = a[5]
            if (weight < 1e-9) { edge++; next }
            differ("another triangle")
        }
        END {
            printf "%s: %d rays: %d hit the same triangle, %d miss in both, %d on an edge; ", name,
                rays, same, missed, edge
            printf "%d differ; largest relative difference of distances %.2g\n", different, worst
            exit different > 0 || same == 0
        }' <(first_of_geometry) "$work/all.txt"
}

if [ $# -lt 1 ] || [ $# -gt 3 ] || [ "$1" = --help ]; then
    usage
    exit 2
fi
[[ ${2:-96x64} =~ ^([1-9][0-9]*)x([1-9][0-9]*)$ ]] || fail "$2: not COLUMNSxROWS"
columns=${BASH_REMATCH[1]} rows=${BASH_REMATCH[2]}
choose "$1"
work=$build/tests/hits-$1
mkdir -p "$work"
provide_geometry "$1"
trace_with_povray
"$build/accel" trace "$scene" --rays "$work/rays.txt" -o "$work/accel.txt" --quiet ${3:+-a "$3"}
[ "$(wc -l <"$work/accel.txt")" -eq "$(wc -l <"$work/hits.txt")" ] || fail "$1: not a hit for each ray"
compare "$1"
