#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
#
# Meshes with Bounding_Method=3: renders the scenes of meshes/ with stock POV-Ray's linear search over
# objects (-MB) and triangles (`hierarchy off`), and with povray-accel, and compares the pixels byte
# for byte; then again with Accelerator_Verify=On. Stock with its own tree in meshes stands beside:
# what differs there are hits that the tree loses.
#
# Ends with 0 only if no pixel and no query differs, and each scene used what it is there for.
set -euo pipefail
# shellcheck source=tests/povray/common.sh
. "$(dirname "${BASH_SOURCE[0]}")/common.sh"

readonly extent=96x72
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
out=$build/tests/meshes
wrong=0

complain() {
    echo "$*" >&2
    wrong=1
}

# picture WHAT BINARY ARGUMENT...: renders the scene of the folder to WHAT.ppm
picture() {
    local what=$1
    shift
    render "$what.log" $extent "$1" +I"$scene" +L"$here/meshes" +MB1 "${@:2}" +O"$what.ppm" ||
        die "$scene, $what: exit code $?: see $PWD/$what.log"
}

different() {
    different_pixels linear.ppm "$1.ppm" $extent
}

# built LOG FIELD: meshes built, and all
built() {
    statistic "$1" '^Accelerator meshes:' "$2"
}

check_scene() {
    local scene=$1 name pixels d o
    name=$(basename "$scene" .pov)
    mkdir -p "$out/$name"
    cd "$out/$name"
    rm -f ./*
    picture linear "$stock" -MB Declare=Hierarchy=0
    picture tree "$stock" -MB
    picture ours "$ours" +BM3
    render verify.log $extent "$ours" +I"$scene" +L"$here/meshes" +MB1 +BM3 Accelerator_Verify=On +WT2 -F ||
        complain "$name: verifying ends with exit code $?"
    pixels=$(different ours)
    [ "$pixels" = 0 ] || complain "$name: $pixels pixels differ from the linear search"
    [ "$(built ours.log 3)" -gt 0 ] || complain "$name: no mesh was built"
    d=$(statistic verify.log '^Accelerator verified:' 5)
    o=$(statistic verify.log '^Accelerator outside:' 3)
    [ "$d" = 0 ] && [ "$o" = 0 ] || complain "$name: $d queries differ, $o hits outside boxes"
    printf '%-12s %10d %12d %6d of %d\n' "$name" "$(different tree)" \
        "$(statistic verify.log '^Accelerator verified:' 3)" "$(built ours.log 3)" "$(built ours.log 5)"
}

need_binaries
printf '%-12s %10s %12s %6s\n' scene "tree loses" verified built
for scene in "$here"/meshes/*.pov; do
    check_scene "$scene"
done
[ "$(built "$out/ties/ours.log" 3)" -lt "$(built "$out/ties/ours.log" 5)" ] ||
    complain "ties: a mesh that no ray comes to was built"
exit $wrong
