#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# accel check: counts, judges, determinism, replay. That it finds mismatches: judge.c.
# shellcheck source=tests/cli/common.sh
. "$(dirname "$0")/common.sh"

expect 0 check cubes:gap=3 --rays 2400 --seed 5
says "judged: all by linear"
says " 0 mismatches; structures are valid"
for each in $kinds; do
    case $each in linear | auto) continue ;; esac
    grep -qE "^ +2400 .* $each(:|\$)" out || fail "$each is not checked by default"
done
[ "$kind" = linear ] || ! grep -qE '^ +2400 .* linear$' out || fail "linear checks itself"
cp out first
expect 0 check cubes:gap=3 --rays 2400 --seed 5 --threads 3
cmp first out || fail "threads change what is printed"
expect 0 check cubes:gap=3 --rays 2400 --seed 6
cmp -s first out && fail "another seed checks the same rays"

# Shares are of the rays that a family has, not of a twelfth of all.
expect 0 check cubes:gap=3 --rays 25
! grep -oE '[0-9]+%' out | tr -d % | awk '$1 > 100 { over = 1 } END { exit !over }' ||
    fail "more rays hit than there are: $(sed -n 3p out)"

# Most rays of every family that aims at something hit; of odd ones some are refused.
sed -n 's/.*of them hit: //p' first >families
for family in vertex edge axis grazing far scaled; do
    grep -qE "$family (100|[5-9][0-9])%" families || fail "few rays hit: $(cat families)"
done
awk -v kind="$kind" 'index($0, "  " kind) { exit !($3 > 20 && $3 < 200) }' first || fail "no odd ray is refused"

# A sample: linear judges what it is told, and another kind is asked where there is only one.
expect 0 check soup:n=3000 -a "$kind" --rays 2400 --judged 240
says "judged: 240 by linear, the same share of each family; all 2400 by agreement of"
if [ "$(grep -cvxE 'linear|auto' <<<"$kinds")" -ge 2 ]; then
    says "agreement of 2 structures"
    says "(added as second opinion)"
fi
expect 0 check soup:n=3000 -a "$kind" -a "$kind" -a linear --rays 1200
says "3600 rays, 0 mismatches"

for scene in empty one same:n=300 nested spheres:n=500; do
    expect 0 check "$scene" --rays 1200
    says " 0 mismatches; structures are valid"
done

# The catalogue's scenes of the tests, of another seed, and with objects of a host, which few commands take.
expect 0 check slivers -a "$kind" --rays 1200
cp out first
expect 0 check slivers:seed=2 -a "$kind" --rays 1200
! cmp -s first out || fail "another seed gives the same scene"
expect 0 check mixed -a "$kind" --rays 1200
complains "has objects of a host, allowed are triangles and spheres" trace mixed -o x.exr

expect 0 check one -a "$kind" --ray "0x1p-2 0.25 1 0 0 -1 0 inf"
[ "$(grep -c 'closest geometry 0 primitive 0 t=0x1p+0 (1) u=0x1p-2 v=0x1p-2' out)" = 2 ] ||
    fail "a replayed ray has other hits: $(cat out)"
expect 0 check one -a "$kind" --ray "0x1p-2 0.25 1 0 0 -1 0 inf 0 0"
[ "$(grep -c 'closest none' out)" = 2 ] || fail "the skipped primitive is hit"
expect 0 check one -a "$kind" --ray "0x1p-2 0.25 1 0 0 -1 0 1"
[ "$(grep -c 'closest none' out)" = 2 ] || fail "tmax is not exclusive"
expect 0 check one -a "$kind" --ray "nan 0.25 1 0 0 -1"
[ "$(grep -c 'closest none' out)" = 2 ] || fail "a NaN hits"
finish
