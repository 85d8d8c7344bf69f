# SPDX-License-Identifier: Apache-2.0
# shellcheck shell=bash
# Sourced by the scripts of scenes/ and tests/: installs what is missing, builds.
#
#     . scenes/prepare.sh
#     prepare demo        what the demo needs: the library, the command, both POV-Rays
#     prepare fast        the library, the command and those tests that need no more
#     prepare tests       what all tests need, but for the patched POV-Ray and the real meshes
#
# All that is made goes to build/ (logs: build/logs/). Only packages that dpkg does not know as
# installed are asked for, so a second run takes seconds and no network. Made for a bare Debian 12:
# bash, coreutils, dpkg and apt are all that it takes for granted; no terminal, no input.

set -euo pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
build=$root/build
logs=$build/logs

# The packages; those to build POV-Ray are known to povray-adapter/build.sh. ca-certificates: for
# mirrors that are reached by https.
packages_build=(ca-certificates gcc g++ make cmake pkg-config libassimp-dev libjansson-dev
    libopenexr-dev libpng-dev librandom123-dev)
packages_stock=(povray povray-includes)
packages_fast=(libcmocka-dev locales python3-minimal)
packages_tests=("${packages_fast[@]}" povray-examples libembree-dev gnuplot-nox libxml2-utils clang
    python3-numpy python3-pip python3-setuptools python3-venv python3-wheel)

# What the choice of auto is fitted to and judged by; the last three come by fetch.sh.
# shellcheck disable=SC2034 # for results.sh and costs.sh
choice_scenes=(cubes:gap=1 cubes:gap=100 cubes:gap=0,space=0.1 teapots teapots:quads=3 stadium stadium:quads=15
    soup:n=1000 soup:n=30000 soup:n=300000 soup:min=0.1,n=3000 soup:max=0.01,n=50000
    soup:min=0.001,max=0.003,n=200000 spheres:n=30 spheres:n=1000 spheres:n=8000 spheres:n=50000
    spheres:n=400000 spheres:n=3000,min=0.05,max=0.1 spheres:n=20000,min=0.02,max=0.05 nested:n=50 same:n=200
    build/scenes/bunny.off build/scenes/armadillo.off build/scenes/dragon.ply)

say() { printf '%s\n' "$*"; }

# Ends the script with one clear line.
die() {
    printf 'accel: %s\n' "$*" >&2
    exit 1
}

# Ends a script that was called wrongly.
bad_usage() {
    printf '%s: %s; --help explains\n' "$(basename "$0")" "$*" >&2
    exit 2
}

# The median of the numbers on stdin, one a line.
median() {
    sort -g | awk '{ v[NR] = $1 } END { print (v[int((NR + 1) / 2)] + v[int(NR / 2) + 1]) / 2 }'
}

# need_folder FOLDER: makes it unless it is there, and sees that files can be written in it.
need_folder() {
    local trouble probe
    trouble=$({ mkdir -p "$1" && probe=$(mktemp "$1/probe.XXXXXX") && echo probe >"$probe" &&
        rm "$probe"; } 2>&1) || die "cannot write to $1: ${trouble##*: }"
}

# Shows the last line of a log while it grows: on a terminal in place, else every 20 seconds.
follow_log() {
    local title=$1 log=$2 start=$SECONDS last='' line width=${COLUMNS:-100} shown=$SECONDS
    [ -t 1 ] && width=$(tput cols 2>/dev/null || say 80)
    while kill -0 $$ 2>/dev/null; do
        sleep 0.3
        line=$(tail -c 400 "$log" 2>/dev/null | tr '\r' '\n' | tr -cd '[:print:]\n' |
            awk 'NF { line = $0 } END { print line }') || true
        line="  $title, $((SECONDS - start)) s: $line"
        if [ -t 1 ]; then
            printf '\r\033[K%s' "${line:0:width-1}"
        elif [ "$line" != "$last" ] && [ $((SECONDS - shown)) -ge 20 ]; then
            printf '%s\n' "${line:0:width-1}"
            shown=$SECONDS
        fi
        last=$line
    done
}

# step TITLE COMMAND...: runs a command with its output in a log and its progress shown.
# The command is in the foreground, so that Ctrl-C reaches it.
step() {
    local title=$1 log start=$SECONDS follower status=0
    shift
    need_folder "$logs"
    log=$logs/$(printf '%s' "$title" | tr -cs 'a-zA-Z0-9' '-').log
    { : >"$log"; } 2>/dev/null || die "cannot write to $log: Permission denied"
    follow_log "$title" "$log" &
    follower=$!
    "$@" >"$log" 2>&1 </dev/null || status=$?
    kill "$follower" 2>/dev/null || true
    wait "$follower" 2>/dev/null || true
    [ -t 1 ] && printf '\r\033[K'
    if [ "$status" -ne 0 ]; then
        tail -n 25 "$log" >&2
        die "$title failed (exit code $status); all of its output: ${log#"$root"/}"
    fi
    say "  $title: done in $((SECONDS - start)) s"
}

# Prints those of the packages that are not installed.
missing_packages() {
    local name
    for name in $(printf '%s\n' "$@" | sort -u); do
        dpkg-query -W -f '${db:Status-Abbrev}' "$name" 2>/dev/null | grep -q '^ii' || say "$name"
    done
}

as_root() {
    if [ "$(id -u)" -eq 0 ]; then
        "$@"
    else
        sudo "$@"
    fi
}

apt_install() {
    as_root env DEBIAN_FRONTEND=noninteractive apt-get -o DPkg::Lock::Timeout=300 -q -y \
        --no-install-recommends install "$@"
}

# Installs those of the packages that are missing; without any, does not touch apt.
install_missing() {
    local missing
    mapfile -t missing < <(missing_packages "$@")
    [ "${#missing[@]}" -gt 0 ] || return 0
    command -v apt-get >/dev/null ||
        die "no apt-get here, but these Debian packages are missing: ${missing[*]}"
    if [ "$(id -u)" -ne 0 ]; then
        command -v sudo >/dev/null ||
            die "neither root nor sudo; as root: apt-get install --no-install-recommends ${missing[*]}"
        sudo -n true 2>/dev/null || sudo -v || die "sudo refused; missing packages: ${missing[*]}"
    fi
    say "Installing ${missing[*]}"
    step "package lists" as_root apt-get -o DPkg::Lock::Timeout=300 -q update
    step "packages" apt_install "${missing[@]}"
}

configure() {
    cmake -S "$root" -B "$build" -DCMAKE_BUILD_TYPE=Release "$@"
}

# The library and the command. The demo leaves the tests out unless they were configured before.
build_accel() {
    if [ "$1" != demo ]; then
        step "configure" configure -DACCEL_TESTS=ON -DACCEL_WERROR=ON
    elif [ ! -e "$build/CMakeCache.txt" ]; then
        step "configure" configure -DACCEL_TESTS=OFF
    fi
    step "library and command" cmake --build "$build" -j "$(nproc)"
}

# check_configs CONFIG...: ends with one line and exit code 2 if one names no structure.
check_configs() {
    local config
    for config in "$@"; do
        [ -n "$config" ] || { echo "accel: '' is no structure; build/accel kinds lists them" >&2 && exit 2; }
        "$build/accel" info one -a "$config" --quiet >/dev/null || exit 2
    done
}

prepare() {
    local packages=("${packages_build[@]}" "${packages_fast[@]}") povray
    mapfile -t povray < <("$root/povray-adapter/build.sh" --packages | tr -s ' \n' '\n')
    need_folder "$logs"
    case $1 in
    demo) packages=("${packages_build[@]}" "${packages_stock[@]}" "${povray[@]}") ;;
    tests) packages+=("${packages_tests[@]}" "${packages_stock[@]}" "${povray[@]}") ;;
    esac
    install_missing "${packages[@]}"
    build_accel "$1"
    [ "$1" != demo ] || build_povray || die "the patched POV-Ray cannot be built"
}

# Exit code 75 where its source cannot be downloaded.
build_povray() {
    "$root/povray-adapter/build.sh" "$build"
}
