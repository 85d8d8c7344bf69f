#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# accel lazy: a row for each power of ten, what was never built, the file of figures. That no time
# is printed where answers differ rests on the judge of accel bench.
# shellcheck source=tests/cli/common.sh
. "$(dirname "$0")/common.sh"

complains "no SCENE" lazy
complains "nosuch.ply" lazy nosuch.ply -a linear
complains "nosuch.ply" lazy one nosuch.ply
complains "linear has no option" lazy one -a linear
complains "--rays" lazy one --rays 0
complains "--repeats" lazy one --repeats 1000
if ! grep -qx hoo <<<"$kinds"; then
    complains "unknown kind 'hoo'" lazy one
    finish
    exit 0
fi

# Of the stadium's two clusters the teapot is too small to be seen.
expect 0 lazy stadium:quads=10 one --rays 1500 --repeats 2 --csv figures.csv
says "stadium:quads=10: 8920 primitives, 2 clusters; every answer of both judged"
for mark in build 1 10 100 1000 1500; do
    grep -qE "^ +$mark +[0-9.]+ +[0-9.]+ +[0-9.]+$" out || fail "there is no row '$mark'"
done
grep -qE '^  clusters +1 of +2 +50\.00 %' out || fail "the hidden cluster was built: $(cat out)"
rows=$(grep -c '^"stadium:quads=10","hoo",' figures.csv)
[ "$rows" = 5 ] || fail "the file has $rows rows instead of 5"
awk -F, 'NR > 1 && !($4 > 0 && $5 > 0 && $6 <= 1500) { exit 1 }' figures.csv ||
    fail "a figure is missing"

expect 0 lazy empty -a hoo:leaf=4 --rays 20 --repeats 1
says "hoo:leaf=4,lazy=on"
complains "leave it out, both are built" lazy one -a hoo:lazy=on
finish
