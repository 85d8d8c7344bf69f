#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
#
# Is a box that holds no hits found out? The boxes of povray-accel hold all that any scene of ours
# makes, so this builds another povray-accel, whose boxes are half of what they should be, and lets it
# verify a scene: hits outside are counted, their objects named, and differences shown.
set -euo pipefail
# shellcheck source=tests/povray/common.sh
. "$(dirname "${BASH_SOURCE[0]}")/common.sh"

here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
out=$build/tests/outside
tree=$out/source
spoiled=$tree/source/backend/accel/povaccelbox.cpp
rule='Include_Box(boxes\[i\], bounds.strays);'

# Only what depends on the spoiled file is compiled.
build_spoiled() {
    rm -rf "$tree"
    mkdir -p "$out"
    cp -a "$build/povray/source" "$tree"
    sed -i "s/$rule/& boxes[i].hi[X] = 0.5 * (boxes[i].lo[X] + boxes[i].hi[X]);/" "$spoiled"
    ! cmp -s "$spoiled" "$build/povray/source/source/backend/accel/povaccelbox.cpp" ||
        die "povaccelbox.cpp has no line to spoil"
    make -C "$tree" >"$out/make.log" 2>&1 || die "compiling failed: see $out/make.log"
}

# expect TEXT PATTERN: a line of the last log
expect() {
    if grep -q "$2" verify.log; then
        echo "ok      $1"
    else
        echo "FAILED  $1: no '$2' in $out/verify.log"
        failed=1
    fi
}

need_binaries
build_spoiled
cd "$out"
failed=0
for kind in bvh octree; do
    status=0
    render verify.log 80x60 "$tree/unix/povray" +I"$here/small.pov" +L"$here" +Overify.ppm +BM3 \
        Accelerator=$kind +BV || status=$?
    [ $status -eq 1 ] || { echo "FAILED  $kind ends with exit code $status, not 1" && failed=1; }
    expect "$kind: hits outside their box are counted" '^Accelerator outside: *[1-9]'
    for object in '2 (pov::Sphere)' '4 (pov::CSGIntersection)' '10 (pov::Mesh)'; do
        expect "  with their object named" "^Accelerator Warning: Hit of object $object at depth"
    done
    expect "  differences are counted" '^Accelerator verified: .*Differences: *[1-9]'
    expect "  and shown" '^Possible Accelerator Error: ray from'
done
rm -rf "$tree"
exit $failed
