# SPDX-License-Identifier: Apache-2.0
# shellcheck shell=bash
# Sourced by the tests of the patched POV-Ray: how to render, and how to compare what came out.
#
# Pictures are PPM with 16 bits a channel, one thread, no antialiasing: the order in which a thread
# draws its random numbers is then the same in every run, and one other hit shows.

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
build=${ACCEL_BUILD:-$root/build}
stock=${STOCK_POVRAY:-povray}
ours=$build/povray-accel
unset POV_ACCELERATOR

die() {
    printf '%s: %s\n' "$(basename "$0")" "$*" >&2
    exit 2
}

# need FILE: one that a download brings, which tests/run.sh told of if it failed. Without it the test
# is skipped, which exit code 77 says; continuous integration insists on it.
need() {
    [ ! -e "$1" ] || return 0
    [ "${CI:-}" != true ] || die "there is no $1"
    echo "skipped, as there is no $1"
    exit 77
}

need_binaries() {
    command -v "$stock" >/dev/null || die "there is no stock POV-Ray ($stock): install povray"
    need "$ours"
}

# render LOG WxH BINARY ARGUMENT...: renders in the current folder, where POV-Ray may write.
# Returns POV-Ray's exit code; its messages, one a line, go to LOG.
render() {
    local log=$1 size=$2 binary=$3 status=0 try
    shift 3
    # POV-Ray gives up if its own threads are not there in time, as on a busy machine
    for ((try = 0; try < 20; try++)); do
        status=0
        "$binary" -D -A +WT1 +FP16 +W"${size%x*}" +H"${size#*x}" "$@" >"$log.raw" 2>&1 </dev/null ||
            status=$?
        grep -aq 'Timed out waiting for worker thread startup' "$log.raw" || break
    done
    tr '\r' '\n' <"$log.raw" >"$log"
    rm -f "$log.raw"
    return $status
}

# pixels PPM WxH: without the header, which holds the date
pixels() {
    tail -c $((${2%x*} * ${2#*x} * 6)) "$1"
}

# different_pixels A.ppm B.ppm WxH: how many; all, if a picture is missing or not whole
different_pixels() {
    local count=$((${3%x*} * ${3#*x})) file
    for file in "$1" "$2"; do
        if [ "$(pixels "$file" "$3" 2>/dev/null | wc -c)" -ne $((count * 6)) ]; then
            echo $count
            return
        fi
    done
    { cmp -l <(pixels "$1" "$3") <(pixels "$2" "$3") || true; } |
        awk '{ print int(($1 - 1) / 6) }' | uniq | wc -l
}

# statistic LOG PATTERN FIELD: a field of the first line that matches
statistic() {
    awk -v pattern="$2" -v field="$3" '$0 ~ pattern { print $field; exit }' "$1"
}

# Every kind that the library knows, one a line
all_kinds() {
    "$build/accel" kinds | awk '!NF { block++ } block == 1 && /^[a-z]/ { print $1 }'
}
