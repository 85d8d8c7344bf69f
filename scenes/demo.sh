#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# Builds everything, renders reference scenes with stock POV-Ray and with ours, and compares them.
#
# Hits are compared, not only pixels: each scene is rendered once more, small, with
# Accelerator_Verify=On, where POV-Ray's own linear search judges every ray; for scenes of triangles
# POV-Ray's trace() also judges the hits of build/accel. Times are CPU seconds of tracing on one
# thread, medians of runs of stock and ours in turn. What is slower is printed like what is faster.
set -euo pipefail
# shellcheck source=scenes/prepare.sh
. "$(dirname "${BASH_SOURCE[0]}")/prepare.sh"

usage() {
    cat <<'HELP'
usage: scenes/demo.sh [-a CONFIG]... [--runs N] [--size WxH] [SCENE]...
  SCENE        clustered, cubes, teapots (these three by default), museum, dragon
  -a CONFIG    accelerator for build/povray-accel, may be repeated (default: hoo)
  --runs N     timed runs of each, stock and ours in turn (2 to 99, default: 2)
  --size WxH   size of the pictures (default: 640x360)
The first run installs packages (apt; sudo where not root) and builds POV-Ray, which takes about ten
minutes; later runs take less than a minute. Pictures and logs go to build/demo/.
Ends with 0 if all hits and pixels agree, 1 if any differs, 2 on bad usage.
HELP
}

configs=() scenes=() runs=2 width=640 height=360

parse_arguments() {
    while [ $# -gt 0 ]; do
        case $1 in
        --help | -h) usage && exit 0 ;;
        -a) [ $# -gt 1 ] || bad_usage "-a needs a CONFIG" ;;&
        --runs) [ $# -gt 1 ] || bad_usage "--runs needs a number" ;;&
        --size) [ $# -gt 1 ] || bad_usage "--size needs WxH" ;;&
        -a) configs+=("$2") && shift ;;
        --runs)
            [[ $2 =~ ^([2-9]|[1-9][0-9])$ ]] || bad_usage "--runs $2: 2 to 99 is allowed"
            runs=$2 && shift
            ;;
        --size)
            [[ $2 =~ ^([1-9][0-9]{0,4})x([1-9][0-9]{0,4})$ ]] || bad_usage "--size $2: not WxH"
            width=${BASH_REMATCH[1]} height=${BASH_REMATCH[2]} && shift
            ;;
        clustered | cubes | teapots | museum | dragon) scenes+=("$1") ;;
        *) bad_usage "$1: not a scene; clustered, cubes, teapots, museum and dragon are" ;;
        esac
        shift
    done
    [ "$width" -le 65536 ] && [ "$height" -le 65536 ] && [ $((width * height)) -le $((1 << 26)) ] ||
        bad_usage "--size ${width}x$height: 65536 a side and 2^26 pixels are allowed"
    [ "${#configs[@]}" -gt 0 ] || configs=(hoo)
    [ "${#scenes[@]}" -gt 0 ] || scenes=(clustered cubes teapots)
}

# render LOG BINARY ARGUMENT...: runs a POV-Ray from the top folder; its exit code.
render() {
    local log=$1 status=0
    shift
    (cd "$root" && "$@" -D -A +WT1 +W"$width" +H"$height" </dev/null 2>&1) | tr '\r' '\n' >"$log" ||
        status=$?
    return "$status"
}

# must_render: the same; its failure ends the demo.
must_render() {
    render "$@" && return
    tail -n 4 "$1" >&2
    die "$2 failed; all of its output: ${1#"$root"/}"
}

# The statistics of POV-Ray in a log.
trace_seconds() { awk '/Trace Time:/ { on = 1 } on && /CPU-seconds/ { print $5; exit }' "$1"; }
rays() { awk '/^Rays:/ { n += $2 } /^Shadow Ray Tests:/ { n += $4 } END { print n + 0 }' "$1"; }
verified() { awk '/^Accelerator verified:/ { print $3 }' "$1"; }
differences() { awk '/^Accelerator verified:/ { print $5 }' "$1"; }

# The pixels of a file without its header, which holds the date.
pixels() { tail -c $((width * height * 6)) "$1"; }

# different_pixels A.ppm B.ppm: the indices of the pixels that differ, one a line.
different_pixels() {
    cmp -l <(pixels "$1") <(pixels "$2") | awk '{ print int(($1 - 1) / 6) }' | uniq || true
}

# progress TEXT: in place on a terminal, else a line.
progress() {
    if [ -t 1 ]; then printf '\r\033[K  %s' "$*"; else say "  $*"; fi
}

# time_both SCENE CONFIG: renders with stock and ours in turn, the first time as PPM to compare,
# then as PNG to look at. Sets stock_time, our_time, ray_count.
time_both() {
    local scene=$1 config=$2 name=$demo/$1 run file
    : >"$name.stock.times"
    : >"$name.ours.times"
    for run in $(seq "$runs"); do
        file=(+FP16 ppm)
        [ "$run" -eq 1 ] || file=(+FN png)
        progress "$scene, $config: run $run of $runs, stock POV-Ray"
        must_render "$name.stock.log" povray "scenes/$scene.ini" "${file[0]}" \
            +O"build/demo/$scene-stock.${file[1]}"
        trace_seconds "$name.stock.log" >>"$name.stock.times"
        progress "$scene, $config: run $run of $runs, our POV-Ray"
        must_render "$name.ours.log" build/povray-accel "scenes/$scene.ini" "${file[0]}" \
            Bounding_Method=3 Accelerator="$config" +O"build/demo/$ours.${file[1]}"
        trace_seconds "$name.ours.log" >>"$name.ours.times"
    done
    stock_time=$(median <"$name.stock.times")
    our_time=$(median <"$name.ours.times")
    ray_count=$(rays "$name.ours.log")
}

# judge_pixels SCENE PIXEL...: renders single pixels with stock's linear search (-MB), which tests
# every object, and says whose pixel that is.
judge_pixels() {
    local scene=$1 name=$demo/$1 pixel row column whose
    shift
    for pixel in "$@"; do
        row=$((pixel / width + 1)) column=$((pixel % width + 1))
        must_render "$name.linear.log" povray "scenes/$scene.ini" -MB +FP16 +SC"$column" \
            +EC"$column" +SR"$row" +ER"$row" +O"build/demo/$scene-linear.ppm"
        whose="neither's: $(pixel_of "$name-linear.ppm" "$pixel")"
        cmp -s <(pixel_of "$name-linear.ppm" "$pixel") <(pixel_of "$name-stock.ppm" "$pixel") &&
            whose="that of stock"
        cmp -s <(pixel_of "$name-linear.ppm" "$pixel") <(pixel_of "$demo/$ours.ppm" "$pixel") &&
            whose="that of accel"
        notes+=("$scene: pixel $column,$row differs; stock's linear search (-MB) gives $whose")
        [ "$whose" = "that of accel" ] || failed=1
    done
}

# pixel_of FILE.ppm INDEX: its six bytes.
pixel_of() {
    od -An -tx1 -N 6 -j $(($(stat -c %s "$1") - (width * height - $2) * 6)) "$1"
}

# verify SCENE CONFIG: a small render in which linear search judges every query; sets verified_count
# and difference_count.
verify() {
    local scene=$1 config=$2 log=$demo/$1.verify.log width=48 height=27
    [ "$scene" != teapots ] || width=32 height=18
    progress "$scene, $config: every ray judged by linear search, at ${width}x$height"
    render "$log" build/povray-accel "scenes/$scene.ini" +FP16 +WT"$(nproc)" Bounding_Method=3 \
        Accelerator="$config" Accelerator_Verify=On +O"build/demo/$scene-verify.ppm" || true
    verified_count=$(verified "$log")
    difference_count=$(differences "$log")
    [ -n "$verified_count" ] || die "$scene: nothing was verified: ${log#"$root"/}"
}

# compare SCENE CONFIG: one row of the table.
compare() {
    local scene=$1 config=$2 differing
    ours=$scene-accel # our picture; with several configs each has its own
    [ "${#configs[@]}" -eq 1 ] || ours+=-${config//[^[:alnum:]]/-}
    time_both "$scene" "$config"
    verify "$scene" "$config"
    mapfile -t differing < <(different_pixels "$demo/$scene-stock.ppm" "$demo/$ours.ppm")
    progress "$scene, $config: ${#differing[@]} pixels differ, $difference_count hits differ"
    [ ! -t 1 ] || say
    judge_pixels "$scene" "${differing[@]:0:5}"
    [ "$difference_count" -eq 0 ] || failed=1
    rows+=("$(awk -v scene="$scene" -v kind="$config" -v rays="$ray_count" \
        -v judged="$verified_count" -v hits="$difference_count" -v pixels="${#differing[@]}" \
        -v stock="$stock_time" -v ours="$our_time" 'BEGIN {
            ratio = ours > 0 ? sprintf("%.2f", stock / ours) : "-"
            printf "%-10s %-14s %9d %9d %9d %9d %8.3f %8.3f %7s",
                scene, kind, rays, judged, hits, pixels, stock, ours, ratio }')")
    written+=("build/demo/$scene-stock.png" "build/demo/$ours.png")
}

# trace_hits SCENE NAME CONFIG: hits of the command as OpenEXR and PNG; a row of the table where
# stock POV-Ray's trace() judges its hits.
trace_hits() {
    local scene=$1 name=$2 config=$3 hits file agree=1
    progress "$name, $config: hits of build/accel, judged by stock POV-Ray's trace()"
    for file in "$name.exr" "$name-hits.png"; do
        "$build/accel" trace "$scene" -o "$demo/$file" -a "$config" --quiet --size "${width}x$height"
        written+=("build/demo/$file")
    done
    hits=$("$root/tests/povray/hits.sh" "$name" 48x27 "$config" | tee "$demo/$name.hits.log" |
        tail -n 1) || agree=0
    [ ! -t 1 ] || say
    rows+=("$(awk -v scene="$name" -v kind="$config" '{
        printf "%-10s %-14s %9d %9d %9d", scene, kind " (accel)", $2, $2, $(NF - 7) }' <<<"$hits")")
    [ "$agree" -eq 1 ] || { failed=1 && cat "$demo/$name.hits.log" >&2; }
}

# POV-Ray leaves the state of an unfinished picture behind.
interrupted() {
    rm -f "$demo"/*.pov-state
    printf '\ndemo.sh: interrupted\n' >&2
    exit 130
}

main() {
    parse_arguments "$@"
    prepare demo
    check_configs "${configs[@]}"
    demo=$build/demo
    need_folder "$demo"
    trap interrupted INT TERM
    rows=() written=() notes=() failed=0
    local scene config
    for scene in "${scenes[@]}"; do
        case $scene in teapots | museum | dragon) "$root/scenes/fetch.sh" "$scene" ;; esac
        for config in "${configs[@]}"; do
            compare "$scene" "$config"
        done
        case $scene in
        cubes) trace_hits cubes:gap=8 cubes "${configs[0]}" ;;
        teapots) trace_hits teapots teapots "${configs[0]}" ;;
        esac
    done
    say
    say "rays: in the picture. judged: rays of a small picture that linear search traced again; for"
    say "(accel), the command's hits, all rays by stock POV-Ray's trace()."
    say "trace: CPU seconds on one thread, median of $runs runs in turn. ratio over 1: ours is faster."
    say
    printf '%-10s %-14s %9s %9s %9s %9s %8s %8s %7s\n' "" "" "" "" differing differing trace trace "" \
        scene kind rays judged hits pixels "stock s" "ours s" ratio
    printf '%s\n' "${rows[@]}"
    say
    [ "${#notes[@]}" -eq 0 ] || printf '%s\n' "${notes[@]}" ''
    mapfile -t written < <(printf '%s\n' "${written[@]}" | awk '!seen[$0]++')
    say "Written:" "${written[@]}"
    exit "$failed"
}

main "$@"
