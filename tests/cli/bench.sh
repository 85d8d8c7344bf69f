#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# accel bench: a row for each contender, counts, the file of figures, peers where they are built in.
# That no time is printed where answers differ rests on accel_same_hit, which judge.c tests.
# shellcheck source=tests/cli/common.sh
. "$(dirname "$0")/common.sh"

expect 0 bench cubes:gap=2 one --count 400 --repeats 2 --csv figures.csv
says "cubes:gap=2: 12288 primitives; every answer of ours judged: equal to "
says "of each kind of rays 400 by linear"
says "one: 1 primitives"
for each in $kinds; do
    [ "$each" = linear ] || grep -q "^$each " out || fail "$each is not timed by default"
done
for each in octree:root=scene hug:form=paper; do
    [[ $kinds != *"${each%%:*}"* ]] || grep -q "^$each " out || fail "$each is not timed by default"
done
[ "$kind" = linear ] || says "auto over 2 scenes: mean regret"
for file in out figures.csv; do
    grep -q '^# compiled by .* at ' "$file" || fail "$file does not say what was timed"
done
rows=$(grep -c '^"cubes:gap=2","'"${kinds##*$'\n'}"'",' figures.csv)
[ "$rows" = 4 ] || fail "the file has $rows rows of the last kind instead of one for each kind of rays"
awk -F, '/primary/ && !($8 >= 0 && $10 > 0) { exit 1 }' figures.csv || fail "a figure is missing"

expect 0 bench cubes:gap=2 -a "$kind" --rays shadow,photon --count 400 --repeats 1 --peers
says "shadow ns"
grep -q 'primary ns' out && fail "primary rays are timed though they were not asked for"
grep -qE '^Embree 3.*other [0-9]' out || says "this build has no peers"

# Without a file the figures are all that is printed; what follows is a scene unless it ends in .csv.
expect 0 bench --csv one --count 10 --repeats 1 -a linear
[ "$(grep -cv '^#' out)" = 5 ] || fail "bare --csv prints more than figures: $(head -c 300 out)"
expect 0 bench one --count 10 --repeats 1 -a linear --csv=figures.txt
[ "$(grep -c '^"one","linear",' figures.txt)" = 4 ] || fail "--csv=FILE writes no figures"
expect 0 bench one --count 10 --repeats 1 -a linear --csv -
[ "$(grep -cv '^#' out)" = 5 ] || fail "--csv - prints more than figures: $(head -c 300 out)"
complains "'figures.txt' behind --csv does not end in .csv" bench one --csv figures.txt
complains "say --csv=new.txt" bench one --csv new.txt
expect 0 bench one --count 10 --repeats 1 --pilot 0
complains "--pilot" bench one --pilot x

complains "nosuch" bench one -a nosuch
complains "no SCENE" bench
complains "no kind of rays" bench one --rays primary,nosuch
complains "nosuch.ply" bench nosuch.ply
complains "nosuch.ply" bench one nosuch.ply # and nothing of the first is measured
complains "soup: n=x is out of range" bench one soup:n=x
complains "--count" bench one --count 0
finish
