#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# accel clusters: families, single scenes, the file of figures. That clustering is linear is shown by
# counted work: tests/library/clusters.c.
# shellcheck source=tests/cli/common.sh
. "$(dirname "$0")/common.sh"

complains "nosuch.ply" clusters nosuch.ply --most 10000
complains "--most" clusters soup --most 5
complains "--repeats" clusters soup --repeats 0
if ! grep -qx hoo <<<"$kinds"; then
    complains "unknown kind 'hoo'" clusters one --most 10000
    finish
    exit 0
fi

expect 0 clusters soup spheres cubes stadium teapots:quads=3 --most 100000 --repeats 1 --csv figures.csv
for row in soup:n=10000 soup:n=100000 spheres:n=10000 spheres:n=100000 cubes:side=7 cubes:side=16 \
    stadium:quads=13 stadium:quads=40 teapots:quads=3; do
    grep -qE "^$row +[0-9]+ +[0-9]+ +[0-9]+ +[0-9.]+ +[0-9.]+ +[0-9.]+ +[0-9.]+ %$" out ||
        fail "there is no row '$row'"
    grep -q "^\"$row\"," figures.csv || fail "the file has no row '$row'"
done
[ "$(wc -l <figures.csv)" = 10 ] || fail "the file has not 9 rows"
awk -F, 'NR > 1 && !($2 > 0 && $3 > 0 && $5 > 0 && $6 > $5) { exit 1 }' figures.csv ||
    fail "a figure is missing"
grep -qE '^cubes:side=16 +98304 +2 +1 ' out || fail "the cubes are not two clusters: $(cat out)"

echo x >bad.off
expect 2 clusters soup:n=10 bad.off --csv other.csv # found to be no mesh after the first is done
grep -q '^soup:n=10 ' out || fail "the first scene was not measured"
[ ! -e other.csv ] || fail "a failed run leaves its file"
finish
