#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
#
# The options of the patched POV-Ray: that the patch is active, which option wins over which, what
# bad values do, that verifying can fail, and that without the options it is stock.
# shellcheck disable=SC2317
set -euo pipefail
# shellcheck source=tests/povray/common.sh
. "$(dirname "${BASH_SOURCE[0]}")/common.sh"

here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
size=80x60
failed=0

# check NAME COMMAND...: one line of the report
check() {
    local name=$1
    shift
    if "$@"; then
        printf 'ok      %s\n' "$name"
    else
        printf 'FAILED  %s\n' "$name"
        failed=1
    fi
}

# run CODE NAME BINARY SCENE ARGUMENT...: does POV-Ray end with CODE?
run() {
    local wanted=$1 name=$2 binary=$3 scene=$4 code=0
    shift 4
    render "$name.log" $size "$binary" +I"$here/$scene.pov" +L"$here" +O"$name.ppm" "$@" || code=$?
    [ $code -eq "$wanted" ] || echo "  $name: exit code $code, not $wanted"
    [ $code -eq "$wanted" ]
}

# built NAME CONFIG: does the log say that this structure was built?
built() {
    grep -q "^Accelerator:      $2\(:.*\)\?\$" "$1.log"
}

says() {
    grep -q "$2" "$1.log"
}

silent() {
    ! grep -q "$2" "$1.log"
}

same_pixels() {
    [ "$(different_pixels "$1.ppm" "$2.ppm" "$size")" -eq 0 ]
}

different() {
    ! same_pixels "$1" "$2"
}

patch_is_active() {
    check "stock takes Bounding_Method=3 for BSP" run 0 stock-3 "$stock" small Bounding_Method=3
    check "  and says so" says stock-3 '^BSP Total Nodes'
    check "  and knows no accelerator" silent stock-3 'Accelerator'
    check "patched builds the structure" run 0 ours-3 "$ours" small Bounding_Method=3 Accelerator=octree
    check "  and says so" built ours-3 octree
    check "  and no BSP" silent ours-3 '^BSP'
    check "  and counts queries" says ours-3 '^Accelerator Query  *[1-9]'
    check "  and nodes" says ours-3 '^Accelerator Node  *[1-9]'
    check "  and leaf tests" says ours-3 '^Accelerator Object  *[1-9]'
}

stock_without_options() {
    local method
    check "stock renders linearly" run 0 stock-MB "$stock" small -MB
    for method in -MB +BM1 +BM2; do
        run 0 "stock$method" "$stock" small "$method"
        check "patched with $method" run 0 "ours$method" "$ours" small "$method"
        check "  is stock" same_pixels "stock$method" "ours$method"
        check "  and silent" silent "ours$method" 'Accelerator'
    done
    check "the image is linear's" same_pixels ours-3 stock-MB
    POV_ACCELERATOR=nonsense run 0 environment "$ours" small +BM1
    check "POV_ACCELERATOR does nothing without method 3" silent environment 'Accelerator'
    run 0 useless "$ours" small Accelerator=octree
    check "Accelerator without method 3 is warned of" says useless 'no effect without'
    check "  and has no effect" silent useless '^Accelerator:'
    run 0 off "$ours" small +BM3 +BXoctree -MB
    check "-MB is linear" says off 'none, linear search'
    check "a scene below the threshold is linear" run 0 threshold "$ours" small +BM3 +BXoctree +MB99
    check "  and says so" says threshold 'none, linear search'
}

precedence() {
    check "no Accelerator: the default" run 0 default "$ours" small +BM3
    check "  is built" says default '^Accelerator:      [a-z]'
    POV_ACCELERATOR=octree:leaf=3 run 0 env "$ours" small +BM3
    check "POV_ACCELERATOR is a default" says env '^Accelerator: .*octree:.*leaf=3'
    printf 'Bounding_Method=3\nAccelerator="octree:leaf=4,depth=5" ; quoted\n' >order.ini
    POV_ACCELERATOR=octree:leaf=3 run 0 ini "$ours" small "$PWD/order.ini"
    check "INI before POV_ACCELERATOR" says ini '^Accelerator: .*octree:.*leaf=4,depth=5'
    run 0 line "$ours" small "$PWD/order.ini" Accelerator=octree:leaf=6
    check "command line before INI" says line '^Accelerator: .*octree:.*leaf=6'
    run 0 switch "$ours" small "$PWD/order.ini" '+BX"octree:leaf=7"'
    check "+BX is Accelerator" says switch '^Accelerator: .*octree:.*leaf=7'
    run 0 verified "$ours" small +BM3 +BV
    check "+BV is Accelerator_Verify" says verified '^Accelerator verified: *[1-9]'
    run 0 unverified "$ours" small +BM3 Accelerator_Verify=On -BV
    check "-BV switches it off" silent unverified '^Accelerator verified'
}

# bad NAME TEXT ARGUMENT...
bad() {
    local name=$1 text=$2
    shift 2
    rm -f "$name.ppm"
    check "$name ends with 1" run 1 "$name" "$ours" small +BM3 "$@"
    check "  with the library's text" says "$name" "$text"
    check "  as a fatal error" says "$name" '^Fatal error'
    check "  and no image" test ! -s "$name.ppm"
}

bad_configurations() {
    bad unknown-kind "^Accelerator: .*octtree" Accelerator=octtree
    bad unknown-key "^Accelerator: .*leef" Accelerator=octree:leef=3
    bad bad-value "^Accelerator: .*leaf" Accelerator=octree:leaf=0
    bad below-threshold "^Accelerator: .*octtree" Accelerator=octtree +MB99
    printf 'Accelerator=octree:leaf=4,depth=5\n' >comma.ini
    bad unquoted-comma "^Accelerator: .*depth" "$PWD/comma.ini"
    check "  with a hint" says unquoted-comma 'in quotes'
}

verifying() {
    local kind
    for kind in $(all_kinds); do
        check "$kind verifies" run 0 "verify-$kind" "$ours" small +BM3 Accelerator="$kind" +BV
        check "  every query" says "verify-$kind" '^Accelerator verified: *[1-9][0-9]* *Differences: *0$'
        check "  and changes no pixel" same_pixels "verify-$kind" stock-MB
    done
    run 0 boxes-stock "$stock" boxes -MB
    run 0 boxes-BM1 "$stock" boxes +BM1
    check "boxes that hold no hits mislead stock's +BM1" different boxes-BM1 boxes-stock
    for kind in $(all_kinds); do
        check "  but not $kind" run 0 "boxes-$kind" "$ours" boxes +BM3 Accelerator="$kind" +BV
        check "    which finds all hits" same_pixels "boxes-$kind" boxes-stock
    done
    run 0 inside-stock "$stock" inside -MB
    for kind in $(all_kinds); do
        check "$kind finds the objects around a point" run 0 "inside-$kind" "$ours" inside +BM3 \
            Accelerator="$kind" +BV
        check "  as verified" says "inside-$kind" '^Accelerator verified: *[1-9][0-9]* *Differences: *0$'
        check "  and changes no pixel" same_pixels "inside-$kind" inside-stock
    done
    # made far away and moved back; stock's own methods fail here
    run 0 far-stock "$stock" far -MB
    check "a box is not rounded to float" run 0 far "$ours" far +BM3 +BXoctree +BV
    check "  nor a surface missed" same_pixels far far-stock
}

# Octrees that rays build: one of two blocks is never seen.
lazy() {
    if ! grep -qx hoo <<< "$(all_kinds)"; then return; fi
    run 0 behind-stock "$stock" behind -MB
    check "lazy renders" run 0 lazy "$ours" behind +BM3 Accelerator=hoo:lazy=on +BV
    check "  as verified" says lazy '^Accelerator verified: *[1-9][0-9]* *Differences: *0$'
    check "  and changes no pixel" same_pixels lazy behind-stock
    check "  begins with nothing built" says lazy 'lazy: 2 of 2 clusters and 686 of 686'
    check "  and ends with what was seen" says lazy '^Accelerator built: *1 of 2 clusters, 343 of 686 '
    check "an eager structure says nothing" silent ours-3 '^Accelerator built'
}

need_binaries
mkdir -p "$build/tests/options"
cd "$build/tests/options"
rm -f ./*
patch_is_active
stock_without_options
precedence
bad_configurations
verifying
lazy
exit $failed
