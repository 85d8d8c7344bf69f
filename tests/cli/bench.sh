#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# accel bench: a row for each contender, counts, the file of figures, peers where they are built in.
# That no time is printed where answers differ rests on accel_same_hit, which judge.c tests.
# shellcheck source=tests/cli/common.sh
. "$(dirname "$0")/common.sh"

expect 0 bench cubes:gap=2 one --count 400 --repeats 2 --csv figures.csv
says "cubes:gap=2: 12288 primitives; every answer of ours judged"
says "one: 1 primitives"
for each in $kinds; do
    [ "$each" = linear ] || grep -q "^$each " out || fail "$each is not timed by default"
done
[ "$kind" = linear ] || says "auto over 2 scenes: mean regret"
rows=$(grep -c '^"cubes:gap=2","'"${kinds##*$'\n'}"'",' figures.csv)
[ "$rows" = 4 ] || fail "the file has $rows rows of the last kind instead of one for each kind of rays"
awk -F, '/primary/ && !($8 >= 0 && $10 > 0) { exit 1 }' figures.csv || fail "a figure is missing"

expect 0 bench cubes:gap=2 -a "$kind" --rays shadow,photon --count 400 --repeats 1 --peers
says "shadow ns"
grep -q 'primary ns' out && fail "primary rays are timed though they were not asked for"
grep -qE '^Embree 3.*other [0-9]' out || says "this build has no peers"

complains "nosuch" bench one -a nosuch
complains "no SCENE" bench
complains "no kind of rays" bench one --rays primary,nosuch
complains "nosuch.ply" bench nosuch.ply
complains "--count" bench one --count 0
finish
