#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# How long do scenes take with stock's methods and with ours? A line for each, the slowest first.
#
# Stock's +BM1 and +BM2 and our +BM3 are compared within one binary, build/povray-accel, on one
# thread; their runs alternate. Times are CPU seconds of tracing, medians. `gain` is the better of
# stock's over ours. `unbounded` counts objects that are tested for every ray, as they have no box.
set -euo pipefail
# shellcheck source=scenes/prepare.sh
. "$(dirname "${BASH_SOURCE[0]}")/prepare.sh"

usage() {
    cat <<'HELP'
usage: scenes/sweep.sh [-s WxH] [-r RUNS] [-t SECONDS] [-a CONFIG] [SCENE[,NAME=VALUE...]]...
  SCENE       a .pov file; without any, all of Debian's povray-examples
  NAME        is declared in the scene
  -s WxH      size of the pictures (default: 160x120)
  -r RUNS     timed runs of each method (default: 3)
  -t SECONDS  leaves out scenes whose first run takes longer (default: 20)
  -a CONFIG   accelerator (default: that of povray-accel)
Scenes that take less than 10 ms to trace are left out: they tell nothing. Pictures and logs go to
build/sweep/, the table also to build/sweep/table.
HELP
}

size=160x120 runs=3 limit=20 config=() scenes=()

parse_arguments() {
    local option
    [[ ${1-} != --help ]] || { usage && exit 0; }
    while getopts s:r:t:a:h option; do
        case $option in
        s) size=$OPTARG ;;
        r) runs=$OPTARG ;;
        t) limit=$OPTARG ;;
        a) config=("Accelerator=$OPTARG") ;;
        h) usage && exit 0 ;;
        *) usage >&2 && exit 2 ;;
        esac
    done
    shift $((OPTIND - 1))
    [[ $size =~ ^[1-9][0-9]{0,4}x[1-9][0-9]{0,4}$ ]] || bad_usage "-s $size: not WxH"
    [[ $runs =~ ^[1-9][0-9]?$ ]] || bad_usage "-r $runs: 1 to 99 is allowed"
    [[ $limit =~ ^[1-9][0-9]{0,4}$ ]] || bad_usage "-t $limit: 1 to 99999 is allowed"
    scenes=("$@")
    [ ${#scenes[@]} -gt 0 ] ||
        mapfile -t scenes < <(find /usr/share/doc/povray/examples -name '*.pov' 2>/dev/null | sort)
    [ ${#scenes[@]} -gt 0 ] || bad_usage "no SCENE, and povray-examples is not installed"
    [ -x "$build/povray-accel" ] || bad_usage "no build/povray-accel: run povray-adapter/build.sh"
}

# trace LOG METHOD: seconds of tracing this job's scene; fails if it takes too long or cannot be rendered
trace() {
    local log=$1 method=$2
    timeout "$limit" "$build/povray-accel" +I"$scene" +L"$(dirname "$scene")" +L"$build/scenes" \
        "${declares[@]}" -D -F -A +WT1 +W"${size%x*}" +H"${size#*x}" "$method" "${config[@]}" \
        >"$log.raw" 2>&1 </dev/null || return 1
    tr '\r' '\n' <"$log.raw" >"$log"
    rm "$log.raw"
    awk '/ Time:/ { on = /Trace Time:/ } on && /CPU-seconds/ { print $5; found = 1; exit }
        END { exit !found }' "$log"
}

# A line of the table: gain, seconds of each method, unbounded and all objects, name
measure() {
    local scene=${1%%,*} name words declares=() run method
    IFS=, read -ra words <<<"$1"
    [ ${#words[@]} -eq 1 ] || declares=("${words[@]:1}")
    declares=("${declares[@]/#/Declare=}")
    name=$(basename "$scene" .pov)${declares:+ ${declares[*]#Declare=}}
    scene=$(realpath "$scene")
    rm -f ./*.times
    for ((run = 0; run < runs; run++)); do
        for method in +BM1 +BM2 +BM3; do
            trace "log$method" $method >>"times$method.times" || return 0
        done
        # the first run of a scene that takes no time says enough
        awk '{ exit !($1 < 0.01) }' "times+BM1.times" && return 0
    done
    printf '%s %s %s ' "$(median <times+BM1.times)" "$(median <times+BM2.times)" \
        "$(median <times+BM3.times)"
    awk '/^  Objects:/ { u = $4; n = $2 } END { printf "%d %d ", u, n }' log+BM3
    printf '%s\n' "$name"
}

parse_arguments "$@"
mkdir -p "$build/sweep"
cd "$build/sweep"
exec {lock}>lock
flock -n "$lock" || die "another scenes/sweep.sh writes to build/sweep; nothing was timed"
count=0
: >rows
for item in "${scenes[@]}"; do
    count=$((count + 1))
    [ ! -t 2 ] || printf '\r\033[K  %d of %d: %s' "$count" "${#scenes[@]}" "$(basename "$item")" >&2
    (cd "$OLDPWD" && realpath -e "${item%%,*}" >/dev/null) || bad_usage "${item%%,*}: no such file"
    measure "$(cd "$OLDPWD" && realpath -e "${item%%,*}")${item#"${item%%,*}"}" >>rows
done
[ ! -t 2 ] || printf '\r\033[K' >&2
{
    printf '%6s %8s %8s %8s %9s %8s  %s\n' gain +BM1 +BM2 +BM3 unbounded objects scene
    awk '{
        best = $1 < $2 ? $1 : $2
        name = $6
        for (i = 7; i <= NF; i++) name = name " " $i
        printf "%6.2f %8.3f %8.3f %8.3f %9d %8d  %s\n", best / ($3 > 0 ? $3 : 1e-3), $1, $2, $3, $4, $5, name
    }' rows | sort -g
} | tee table
