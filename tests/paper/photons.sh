#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# accel photons and accel tables as a user runs them.
# shellcheck source=tests/cli/common.sh
. "$(dirname "$0")/../cli/common.sh"

# hash CONFIG: of the hits, on the line of CONFIG.
hash() {
    awk -v config="$1" '$1 == config { print $NF }' out
}

# Every kind, any number of threads: the same hits and the same irradiance, in every bit.
configs=()
for each in $kinds; do configs+=(-a "$each"); done
expect 0 photons cubes:gap=2 "${configs[@]}" --photons 2000 --size 40x30 -o all.exr
[ "$(grep -c 'irradiance by paths' out)" = "$(wc -w <<<"$kinds")" ] || fail "a kind is missing"
first=$(hash linear)
[ "${#first}" = 16 ] || fail "no hash for linear: $(cat out)"
for each in $kinds; do
    [ "$(hash "$each")" = "$first" ] || fail "$each has other hits than linear"
done
expect 0 photons cubes:gap=2 -a "$kind" --photons 2000 --threads 3 --size 40x30 -o three.exr
[ "$(hash "$kind")" = "$first" ] || fail "threads change the hits"
expect 0 diff all.exr three.exr
says "1200 pixels, 1 channels: 0 pixels differ"

# What should change the result does.
for option in "--seed 2" "--photons 2001" "--reflectance 0.6" "--light 0,40,0:15,0,0:0,0,15"; do
    # shellcheck disable=SC2086
    photons="--photons 2000"
    [[ $option != --photons* ]] || photons=
    # shellcheck disable=SC2086
    expect 0 photons cubes:gap=2 -a "$kind" $photons --time-only $option
    [ "$(hash "$kind")" != "$first" ] || fail "$option changes nothing"
    grep -q irradiance out && fail "--time-only estimates irradiance"
done
expect 0 photons cubes:gap=2 -a "$kind" --photons 2000 --size 40x30 --estimate nearest -o near.exr
says "irradiance by nearest photons"
expect 1 diff all.exr near.exr
expect 0 photons cubes:gap=2 -a "$kind" --photons 2000 --size 40x30 -o all.png
[ "$(head -c 4 all.png | tail -c 3)" = PNG ] || fail "the picture is no PNG"

# Nothing to light, and little.
for scene in empty one same:n=100 nested:n=9 spheres:n=50; do
    expect 0 photons "$scene" -a "$kind" -a linear --photons 500 --size 8x6
done

complains "no SCENE is given; usage: accel photons" photons
complains "nearest is teapots" photons teapot
complains "did you mean '$kind'" photons one -a linear -a "${kind}x"
complains "--photons is '0'" photons one --photons 0
complains "--reflectance is '1'" photons one --reflectance 1
complains "--reflectance is 'nan'" photons one --reflectance nan
complains "--threads is '0'" photons one --threads 0
complains "--radius is '0'" photons one --radius 0
complains "--nearest is '1'" photons one --nearest 1
complains "allowed are paths, nearest" photons one --estimate near
complains "its edges span no area" photons one --light 0,0,0:1,0,0:2,0,0
complains "WxH" photons one --size 3
complains "is no camera" photons one --camera 0
complains "neither .exr nor .png" photons one -o x.jpg
complains "leaves out" photons one --time-only -o x.png
complains "nothing was written" photons one -o missing/x.png

# The table that is quickest here, and its figures.
expect 0 tables --quick --table 1 --photons 200 --repeats 1 --csv figures.csv
says "Triangles tested per ray"
lines=$(grep -c '"' figures.csv || true)
[ "$lines" = "$(grep -cE '^(hoo|octree|bvh).* +[0-9]+%' out || true)" ] ||
    fail "$lines lines of figures: $(cat out)"
complains "allowed is a whole number from 1 to 3" tables --table 4
complains "unexpected 'x'" tables x
complains "nothing was written" tables --csv missing/x.csv
finish
