#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
#
# Renders scenes of random objects (objects/scene.c) with povray-accel and with stock POV-Ray's
# linear search (-MB, and `hierarchy off` in meshes). For each scene:
# - Accelerator_Verify=On, once for each of three cameras: no hit of any object lies outside the
#   object's box, no query differs from the linear search;
# - all kinds of structure: each pixel is that of -MB;
# - no more objects are without bounds than the generator, which knows what it wrote, allows.
#
# Ends with 0 only if all of that holds. What fails is printed with the commands that show it, and
# with the objects that fail when they are alone.
set -euo pipefail
# shellcheck source=tests/povray/common.sh
. "$(dirname "${BASH_SOURCE[0]}")/common.sh"

usage() {
    cat <<'HELP'
usage: objects.sh [-s SEED] [-n SCENES] [-t SHAPE] [-k KIND]... [-j JOBS]
  -s SEED    of the first scene (default: 0); the others follow
  -n SCENES  how many (default: 12); 30 objects each
  -t SHAPE   of each object, where others take turns; random_objects names them
  -k KIND    compare the pixels of this kind (default: every kind); may be repeated
  -j JOBS    scenes at the same time (default: the number of processors)
HELP
}

count=30 rays=60 size=30x60 # a pixel for each ray
kinds=() first=0 scenes=12 jobs=$(nproc) type_option=()

parse_arguments() {
    local option
    while getopts s:n:t:k:j:h option; do
        case $option in
        s) first=$OPTARG ;;
        n) scenes=$OPTARG ;;
        t) type_option=(--type "$OPTARG") ;;
        k) kinds+=("$OPTARG") ;;
        j) jobs=$OPTARG ;;
        h) usage && exit 0 ;;
        *) usage >&2 && exit 2 ;;
        esac
    done
    [ $OPTIND -gt $# ] || { usage >&2 && exit 2; }
    [ ${#kinds[@]} -gt 0 ] || mapfile -t kinds < <(all_kinds)
    [ ${#kinds[@]} -gt 0 ] || die "$build/accel names no kind: build it, or give -k"
    generator=$build/tests/povray/random_objects
    [ -x "$generator" ] || die "there is no $generator: build it"
}

# generate FILE ARGUMENT...
generate() {
    "$generator" "$seed" --count $count --rays $rays "${type_option[@]}" "${@:2}" >"$1"
}

# Bounds are kept in every other scene, unions are split in two of three.
choose_options() {
    options=(+MB1 -UR -SU)
    [ $((seed % 2)) -eq 0 ] || options[1]=+UR
    [ $((seed % 3)) -eq 0 ] || options[2]=+SU
}

# try WHAT BINARY ARGUMENT...: renders scene.pov to WHAT.ppm
try() {
    local status=0
    render "$1.log" $size "$2" +Iscene.pov "${options[@]}" "${@:3}" +O"$1.ppm" || status=$?
    [ $status -eq 0 ] ||
        echo "$1 ends with exit code $status: $(grep -a -m 1 'rror' "$1.log" || tail -n 1 "$1.log")"
    return $status
}

same_picture() {
    local n
    n=$(different_pixels "$1.ppm" "$2.ppm" $size)
    [ "$n" -eq 0 ] || echo "$1: $n pixels differ from -MB"
}

# verify KIND VIEW FILE: what is wrong, if anything
verify() {
    local file=verify-$2 status=0 queries outside different
    render "$file.log" $size "$ours" +I"$3" "${options[@]}" +BM3 Accelerator="$1" \
        Accelerator_Verify=On Declare=View="$2" +O"$file.ppm" || status=$?
    queries=$(statistic "$file.log" '^Accelerator verified:' 3)
    different=$(statistic "$file.log" '^Accelerator verified:' 5)
    outside=$(statistic "$file.log" '^Accelerator outside:' 3)
    if [ -z "$queries" ] || [ -z "$outside" ]; then
        echo "$1, view $2: not verified, exit code $status: $(grep -a -m 1 rror "$file.log")"
    elif [ $status -ne 0 ] || [ "$different" -ne 0 ] || [ "$outside" -ne 0 ]; then
        echo "$1, view $2: $different of $queries queries differ, $outside hits are outside" \
            "their boxes, exit code $status"
    fi
    echo "${queries:-0}" >>queries
    statistic "$file.log" '^Accelerator Object' 4 >>hits
}

check_unbounded() {
    local allowed found
    allowed=$(awk '/^\/\/ unbounded/ { print $3 }' scene.pov)
    found=$(awk '/Unbounded:/ { print $4; exit }' verify-0.log)
    [ "${found:-0}" -le "$allowed" ] ||
        echo "${found:-0} objects have no bounds, where $allowed or fewer would do"
}

# blame KIND VIEW: the objects that fail alone, and how to see it; once a scene
blame() {
    local i message
    [ ! -f one.pov ] || return 0
    for ((i = 0; i < count; i++)); do
        generate one.pov --only $i
        message=$(verify "$1" "$2" one.pov)
        if [ -n "$message" ]; then
            echo "    alone: $(awk '/^\/\/ object/ { print substr($0, 4) }' one.pov): ${message#*: }"
            echo "        build/tests/povray/random_objects $seed --count $count --rays $rays" \
                "${type_option[*]} --only $i >one.pov; build/povray-accel +Ione.pov -D +W${size%x*}" \
                "+H${size#*x} ${options[*]} +BM3 Accelerator=$1 Accelerator_Verify=On" \
                "Declare=View=$2"
        fi
    done
}

# One scene, in a folder of its own; what is wrong goes to `wrong`.
run_scene() {
    local view kind turn message
    choose_options
    generate scene.pov
    : >wrong
    for view in 0 1 2; do
        turn=$(((seed + view) % ${#kinds[@]}))
        kind=${kinds[turn]}
        try "stock-$view" "$stock" -MB Declare=View="$view" Declare=Trees_Off=1 >>wrong || continue
        message=$(verify "$kind" $view scene.pov)
        [ $view -gt 0 ] || check_unbounded >>wrong
        if [ -n "$message" ]; then
            echo "$message" >>wrong
            blame "$kind" $view >>wrong
            continue
        fi
        same_picture verify-$view "stock-$view" >>wrong
    done
    for kind in "${kinds[@]}"; do
        try "${kind//[:,=]/-}" "$ours" +BM3 Accelerator="$kind" >>wrong || continue
        same_picture "${kind//[:,=]/-}" stock-0 >>wrong
    done
    echo done >finished
}

start_job() {
    seed=$1
    mkdir -p "$out/$seed"
    cd "$out/$seed"
    rm -f ./*
    run_scene >failure 2>&1 || true
    if [ -s failure ] || [ ! -f finished ]; then
        echo "the test itself failed: $(tail -n 1 failure)" >>wrong
    fi
    if [ -t 1 ]; then printf '\r\033[K  scene %s is done' "$seed"; fi
}

# Sum of the numbers in the files of that name
total() {
    cat "${folders[@]/%//$1}" 2>/dev/null | awk '{ n += $1 } END { print n + 0 }'
}

report() {
    local seed folders=()
    if [ -t 1 ]; then printf '\r\033[K'; fi
    for ((seed = first; seed < first + scenes; seed++)); do
        folders+=("$out/$seed")
    done
    echo "Shapes in $((scenes * count)) random objects:"
    cat "${folders[@]/%//scene.pov}" |
        awk '/^\/\/ wrote/ { if (!($3 in n)) name[++names] = $3; n[$3] += $4 }
            END { for (i = 1; i <= names; i++)
                      printf "%-16s %7d%s", name[i], n[name[i]], i % 3 == 0 || i == names ? "\n" : "   " }'
    echo "$(total queries) queries verified, $(total hits) hits of objects in them;" \
        "pictures compared with -MB: ${kinds[*]}"
    for ((seed = first; seed < first + scenes; seed++)); do
        [ -s "$out/$seed/wrong" ] || continue
        echo "FAILED seed $seed (objects.sh -s $seed -n 1 ${type_option[*]}, in $out/$seed):"
        sed 's/^/  /' "$out/$seed/wrong"
        wrong=1
    done
    [ "$(total queries)" -gt 0 ] || die "no query was verified"
}

parse_arguments "$@"
need_binaries
out=$build/tests/objects
mkdir -p "$out"
for ((next = first; next < first + scenes; next++)); do
    while [ "$(jobs -rp | wc -l)" -ge "$jobs" ]; do wait -n || true; done
    (start_job "$next") &
done
wait
wrong=0
report
exit $wrong
