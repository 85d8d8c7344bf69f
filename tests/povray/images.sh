#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
#
# Renders scenes with stock POV-Ray's linear search (-MB, and `hierarchy off` in our own meshes) and
# with povray-accel, once with each kind of structure, and compares the pixels byte for byte. Stock's
# own +BM1 and +BM2 stand beside: where they deviate from -MB, stock's methods disagree with each
# other. Then renders each scene again with Accelerator_Verify=On, where every query is compared with
# a linear search, object and depth.
#
# Ends with 0 only if no pixel and no query differs, and every scene was rendered and verified.
set -euo pipefail
# shellcheck source=tests/povray/common.sh
. "$(dirname "${BASH_SOURCE[0]}")/common.sh"

usage() {
    cat <<'HELP'
usage: images.sh [-k KIND]... [-v KIND]... [-s WxH] [-j JOBS] [SCENE[@WxH][,NAME=VALUE]...]...
  SCENE    a .pov file; without any, 19 of Debian's povray-examples
  NAME     is declared in the scene, such as Photons=1
  -k KIND  what to compare, as for Accelerator= (default: every kind); may be repeated
  -v KIND  what to verify (default: octree and hoo)
  -s WxH   size for a SCENE without one of its own (default: 96x72)
  -j JOBS  scenes rendered at the same time (default: the number of processors)
HELP
}

# Sizes after the time that the linear search takes.
readonly examples=/usr/share/doc/povray/examples
readonly example_scenes=(
    bsp/Tango@16x12 advanced/abyss@8x6 advanced/blocks/stackertransp@24x18
    advanced/landscape@80x60 advanced/isocacti@64x48 advanced/chess2@112x84
    advanced/drums2/drums@96x72 advanced/teapot/teapot2@64x48 advanced/teapot/teapot3@80x60
    advanced/teapot/teapot4@80x60 advanced/float5@128x96 advanced/sombrero@128x96
    advanced/woodbox@128x96 advanced/swirlbox@128x96 advanced/glasschess/glasschess@128x96
    advanced/crater/crater@128x96 objects/mesh2@128x96 advanced/lamppost@128x96
    advanced/pawns@160x120)

kinds=() verified_kinds=() scenes=() size=96x72 jobs=$(nproc)

parse_arguments() {
    local option
    while getopts k:v:s:j:h option; do
        case $option in
        k) kinds+=("$OPTARG") ;;
        v) verified_kinds+=("$OPTARG") ;;
        s) size=$OPTARG ;;
        j) jobs=$OPTARG ;;
        h) usage && exit 0 ;;
        *) usage >&2 && exit 2 ;;
        esac
    done
    shift $((OPTIND - 1))
    scenes=("$@")
    [[ $size =~ ^[1-9][0-9]*x[1-9][0-9]*$ ]] || die "-s $size: not WxH"
    [ ${#kinds[@]} -gt 0 ] || mapfile -t kinds < <(all_kinds)
    [ ${#kinds[@]} -gt 0 ] || die "$build/accel names no kind: build it, or give -k"
    [ ${#verified_kinds[@]} -gt 0 ] || verified_kinds=(octree hoo)
    if [ ${#scenes[@]} -eq 0 ]; then
        [ -d $examples ] || die "there is no $examples: install povray-examples"
        scenes=("${example_scenes[@]/#/$examples/}")
    fi
}

# The meshes of the scene in build/scenes/, each searched linearly as well: in reference/
search_meshes_linearly() {
    local mesh
    mkdir -p reference
    for mesh in $(sed -n 's/^ *#include "\(.*\)"$/\1/p' "$scene"); do
        [ -e "$build/scenes/$mesh" ] || continue
        # a mesh ends with two lines of one brace
        awk '$0 == "}" && last == "}" { print "hierarchy off" } { print; last = $0 }' \
            "$build/scenes/$mesh" >"reference/$mesh"
    done
}

# try WHAT BINARY ARGUMENT...: renders the scene of this job to WHAT.ppm, or fails the job
try() {
    local what=$1
    shift
    # +MB1: the two objects of crater are too few for the usual threshold
    render "$what.log" "$size" "$1" +I"$scene" +L"$(dirname "$scene")" \
        +MB1 "${@:2}" +L"$build/scenes" "${declares[@]}" +O"$what.ppm" && return
    grep -a 'rror' "$what.log" | head -n 3 || tail -n 3 "$what.log"
    echo "FAILED $what: see $PWD/$what.log"
    exit 1
}

# compare WHAT: pixels of WHAT.ppm that are not those of stock's linear search
compare() {
    different_pixels linear-search.ppm "$1.ppm" "$size"
}

# One scene, in a folder of its own; writes `row`, and what is wrong to `wrong`.
run_scene() {
    local scene=$1 name=$2 kind file count row
    : >wrong
    search_meshes_linearly
    try linear-search "$stock" +Lreference -MB
    rm -r reference
    try BM1 "$stock" +BM1
    try BM2 "$stock" +BM2
    row=$(printf '%-19s %7s %6d %6d' "$name" "$size" "$(compare BM1)" "$(compare BM2)")
    for kind in "${kinds[@]}"; do
        file=${kind//[:,=]/-}
        try "$file" "$ours" +BM3 Accelerator="$kind"
        grep -q '^Accelerator:      .*:\|^Accelerator:      [a-z]*$' "$file.log" ||
            echo "$name, $kind: the log has no statistics of the accelerator" >>wrong
        check_illumination "$file.log" >>wrong
        count=$(compare "$file")
        [ "$count" -eq 0 ] || echo "$name, $kind: $count pixels differ from -MB" >>wrong
        row+=$(printf ' %6d' "$count")
    done
    verify_scene
    printf '%s\n' "$row" >row
}

# check_illumination LOG: what is wrong if the scene asks for photons or radiosity and got none
check_illumination() {
    [[ $name != *-Photons=* ]] || grep -q '^Surface photons stored: *[1-9]' "$1" ||
        echo "$name: no photon was stored"
    [[ $name != *-Radiosity=* ]] || grep -q '^Radiosity sample rays shot: *[1-9]' "$1" ||
        echo "$name: radiosity shot no ray"
}

# Adds queries and differences to the row.
verify_scene() {
    local kind queries=0 differences=0 outside=0 q d o
    for kind in "${verified_kinds[@]}"; do
        file=verify-${kind//[:,=]/-}
        render "$file.log" "$size" "$ours" +I"$scene" +L"$(dirname "$scene")" \
            +L"$build/scenes" "${declares[@]}" +MB1 +BM3 Accelerator="$kind" Accelerator_Verify=On \
            +O"$file.ppm" ||
            echo "$name, $kind: verifying ends with exit code $?" >>wrong
        q=$(statistic "$file.log" '^Accelerator verified:' 3)
        d=$(statistic "$file.log" '^Accelerator verified:' 5)
        o=$(statistic "$file.log" '^Accelerator outside:' 3)
        [ "${q:-0}" -gt 0 ] || echo "$name, $kind: no query was verified" >>wrong
        [ "${d:-1}" -eq 0 ] || echo "$name, $kind: $d of $q queries differ" >>wrong
        [ "$(compare "$file")" -eq 0 ] || echo "$name, $kind: verifying changes the image" >>wrong
        queries=$((queries + ${q:-0})) differences=$((differences + ${d:-0}))
        outside=$((outside + ${o:-0}))
    done
    row+=$(printf ' %10d %5d %7d' $queries $differences $outside)
    echo $queries >queries
}

# item_scene, item_size, item_name ITEM: the parts of SCENE[@WxH][,NAME=VALUE]...
item_scene() {
    local file=${1%%[@,]*}
    [[ $file == *.pov ]] || file+=.pov
    printf '%s' "$file"
}

item_size() {
    local rest=${1%%,*}
    [[ $rest == *@* ]] && printf '%s' "${rest##*@}" || printf '%s' "$size"
}

item_name() {
    local words
    IFS=, read -ra words <<<"$1"
    printf '%s' "$(basename "$(item_scene "$1")" .pov)"
    [ ${#words[@]} -eq 1 ] || printf -- '-%s' "${words[@]:1}"
}

# start_job ITEM: in the background, in its own folder
start_job() {
    local scene name words declares=()
    name=$(item_name "$1")
    size=$(item_size "$1")
    scene=$(realpath -e "$(item_scene "$1")") || exit 1
    IFS=, read -ra words <<<"$1"
    [ ${#words[@]} -eq 1 ] || declares=("${words[@]:1}")
    declares=("${declares[@]/#/Declare=}")
    mkdir -p "$out/$name"
    cd "$out/$name"
    rm -rf ./*
    run_scene "$scene" "$name" >failure 2>&1 || echo "$name: $(tail -n 1 failure)" >>wrong
    if [ -t 1 ]; then printf '\r\033[K  %s is done' "$name"; fi
}

print_table() {
    local item name total=0
    if [ -t 1 ]; then printf '\r\033[K'; fi
    echo "Pixels that differ from stock POV-Ray -MB; queries verified with ${verified_kinds[*]}"
    printf '%-19s %7s %6s %6s' scene size +BM1 +BM2
    printf ' %6.6s' "${kinds[@]}"
    printf ' %10s %5s %7s\n' verified wrong outside
    for item in "${scenes[@]}"; do
        name=$(item_name "$item")
        cat "$out/$name/row" 2>/dev/null || printf '%-19s FAILED\n' "$name"
        total=$((total + $(cat "$out/$name/queries" 2>/dev/null || echo 0)))
    done
    echo "$total queries verified"
}

# The meshes that our own scenes include.
need_meshes() {
    local item scene mesh
    for item in "${scenes[@]}"; do
        scene=$(item_scene "$item")
        [ "$(dirname "$scene")" = "$root/scenes" ] || continue
        for mesh in $(sed -n 's/^ *#include "\(.*\)"$/\1/p' "$scene"); do
            [ -e "$root/scenes/$mesh" ] || need "$build/scenes/$mesh"
        done
    done
}

parse_arguments "$@"
need_binaries
need_meshes
out=$build/tests/images
mkdir -p "$out"
for item in "${scenes[@]}"; do
    while [ "$(jobs -rp | wc -l)" -ge "$jobs" ]; do wait -n || true; done
    (start_job "$item") &
done
wait
print_table
wrong=0
for item in "${scenes[@]}"; do
    name=$(item_name "$item")
    if [ ! -s "$out/$name/row" ] || [ -s "$out/$name/wrong" ]; then
        wrong=1
        cat "$out/$name/wrong" 2>/dev/null || echo "$name: there is no such scene"
    fi
done
exit $wrong
