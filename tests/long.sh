#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# What takes longer than tests/run.sh, or another tree of builds: see --help.
set -euo pipefail
# shellcheck source=scenes/prepare.sh
. "$(dirname "${BASH_SOURCE[0]}")/../scenes/prepare.sh"

usage() {
    cat <<'HELP'
usage: tests/long.sh [STEP]...
  clang    clang, optimised: no warning, the library's tests in small, the bits that gcc's build
           gives in full
  native   gcc -O3 -march=native in the same way
  subsets  libraries of some kinds: tests/subsets.sh
  asan     gcc with AddressSanitizer and UndefinedBehaviorSanitizer: library and command, in small
  tsan     clang with ThreadSanitizer: threads
  msan     clang with MemorySanitizer: the library, in small
  deep     the library's tests with 5 times the rays
  rays     tests/rays.sh: 50 million rays
  objects  tests/povray/objects.sh: 3,000 random objects in POV-Ray
All of them by default. Each is built in a folder of its own, build-NAME; tests/run.sh must have
built build/. Logs are in build/logs. Ends with 1 if a step fails, after the others have run.
HELP
}

all=(clang native subsets asan tsan msan deep rays objects)

# The steps' failures are looked at by hand: what calls them, step, turns set -e off.

# preset NAME: configures, builds and tests one preset of CMakePresets.json.
preset() {
    cd "$root" && cmake --preset "$1" && cmake --build --preset "$1" -j "$(nproc)" &&
        ctest --preset "$1" -j "$(nproc)"
}

# same_bits FOLDER: does its command trace what build/accel does?
same_bits() {
    local kind kinds arguments=(trace teapots:quads=3 --size 96x64 --quiet)
    mapfile -t kinds < <("$build/accel" kinds | awk '!NF { b++ } b == 1 && /^[a-z]/ { print $1 }')
    [ "${#kinds[@]}" -gt 1 ] || { echo "$build/accel names no kinds" && return 1; }
    for kind in "${kinds[@]}"; do
        "$build/accel" "${arguments[@]}" -a "$kind" -o "$1/expected.exr" &&
            "$1/accel" "${arguments[@]}" -a "$kind" -o "$1/found.exr" &&
            "$build/accel" diff "$1/expected.exr" "$1/found.exr" || return 1
    done
}

clang() { preset clang && same_bits "$root/build-clang"; }
native() { preset native && same_bits "$root/build-native"; }
asan() { preset asan; }
tsan() { preset tsan; }
msan() { preset msan; }
subsets() { "$root/tests/subsets.sh"; }
rays() { "$root/tests/rays.sh" 50; }
objects() { "$root/tests/povray/objects.sh" -s 1000 -n 100; }
deep() { cd "$root" && ctest --preset deep -j "$(nproc)"; }

for name; do
    case $name in
    --help | -h) usage && exit 0 ;;
    esac
    [[ " ${all[*]} " == *" $name "* ]] || {
        printf 'long.sh: %s: not a step; %s are\n' "$name" "${all[*]}" >&2
        exit 2
    }
done
[ $# -gt 0 ] || set -- "${all[@]}"
[ -x "$build/accel" ] || die "there is no build/accel: tests/run.sh builds it"

failed=()
for name; do
    (step "long test $name" "$name") || failed+=("$name")
done
[ ${#failed[@]} -eq 0 ] || die "failed: ${failed[*]}"
