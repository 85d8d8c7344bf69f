#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# Checks every kind and form over six scenes with many millions of rays: too long for tests/run.sh.
set -euo pipefail
# shellcheck source=scenes/prepare.sh
. "$(dirname "${BASH_SOURCE[0]}")/../scenes/prepare.sh"

if [ "${1:-}" = --help ]; then
    cat <<'HELP'
usage: tests/rays.sh [MILLIONS [SEED]]
Runs 'accel check' with every kind and form on the dragon, cubes, teapots, a soup of 10^5 triangles
of sizes 10^-6..1, a teapot in a stadium and 10^5 spheres: MILLIONS (default 50) of rays or more in
all, counted once for each structure. Linear search judges 20,000 rays of each scene at least,
agreement of the structures the others. Ends with 1 where any answer differs.
HELP
    exit 0
fi
millions=${1:-50} seed=${2:-1}
[ $# -le 2 ] || bad_usage "$# arguments; two are allowed"
[[ $millions =~ ^[1-9][0-9]{0,5}$ ]] || bad_usage "'$millions' millions; 1 to 999999 are allowed"
[[ $seed =~ ^[0-9]{1,15}$ ]] || bad_usage "seed '$seed'; a whole number is allowed"
[ -x "$build/accel" ] || die "no build/accel; ./scenes/demo.sh builds it"
"$root/scenes/fetch.sh" dragon

# The share of all rays, in percent: the least for those that every ray costs the most.
shares=('20:build/scenes/dragon.ply' '20:cubes' '20:teapots' '19:soup:n=100000,min=1e-6,max=1'
    '2:stadium' '19:spheres:n=100000')
cd "$root"
mkdir -p "$build/rays"
kinds=$(build/accel check empty -n 1 -q | grep -c '  [a-z]*:')
total=0 wrong=0
for item in "${shares[@]}"; do
    scene=${item#*:}
    log=$build/rays/$(tr -c 'a-z0-9\n' - <<<"$scene").log
    count=$((millions * 10000 * ${item%%:*} / kinds + 1))
    build/accel check "$scene" -n "$count" -s "$seed" | tee "$log" || wrong=1
    rays=$(awk '/ rays, .* mismatches/ { print $1 }' "$log")
    total=$((total + ${rays:-0}))
    say
done
say "$total rays in all$([ $wrong -eq 0 ] && echo ', 0 mismatches' || echo '; there are mismatches')"
exit $wrong
