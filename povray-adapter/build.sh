#!/bin/bash
# SPDX-License-Identifier: AGPL-3.0-or-later
#
# Builds BUILD_DIR/povray-accel: POV-Ray from Debian's source package, with the patches of this
# folder, its adapter sources and BUILD_DIR/libaccel.a.
#
#     build.sh [BUILD_DIR]     default: build/ beside this folder
#     build.sh --packages      prints the Debian packages that the build needs
#
# Exit code 75 where the download failed, 1 for any other failure.
#
# POV-Ray's own code is compiled as Debian compiles it, so that stock and patched differ by the
# patches alone. Everything lives in BUILD_DIR/povray: download/ (Debian's files), source/ (the
# tree), build.log. A step that fails leaves nothing that a later run would take for done. A later
# run compiles what changed, no more.
set -euo pipefail
export LC_ALL=C

readonly version=1:3.7.0.10-2 suite=bookworm
readonly dsc=povray_${version#*:}.dsc
readonly packages="dpkg-dev xz-utils patch make g++ autoconf automake autoconf-archive pkg-config
    libboost-thread-dev libboost-date-time-dev zlib1g-dev libpng-dev libjpeg-dev libtiff-dev
    libopenexr-dev povray-includes"
# what dpkg-buildflags and debian/rules give, but for -g; prefix and sysconfdir name the folders of
# Debian's povray and povray-includes
readonly configuration=(
    --prefix=/usr --sysconfdir=/etc --localstatedir=/var
    --disable-optimiz --disable-strip --without-x --without-libsdl
    --with-boost-thread=boost_thread
    "COMPILED_BY=povray-adapter of accel, for <local use>"
    "CXXFLAGS=-O2 -fstack-protector-strong -Wformat -Werror=format-security -O3"
    "CPPFLAGS=-Wdate-time -D_FORTIFY_SOURCE=2"
    "LDFLAGS=-Wl,-z,relro -Wl,-z,now")

here=$(cd "$(dirname "$0")" && pwd)

fail() {
    echo "povray-adapter: $*" >&2
    exit 1
}

# say TEXT: progress, rewritten in place on a terminal
say() {
    if [ -t 1 ]; then printf '\r\033[Kpovray-accel: %s' "$*"; else echo "povray-accel: $*"; fi
}

# logged WHAT COMMAND...: runs quietly; on failure shows the end of the log
logged() {
    local what=$1
    shift
    "$@" >> "$log" 2>&1 && return
    end_line
    tail -n 15 "$log" >&2
    fail "$what failed: see $log"
}

end_line() {
    if [ -t 1 ]; then echo; fi
}

list_packages() {
    tr -s '[:space:]' ' ' <<< "$packages"
}

check_tools() {
    local missing=
    for tool in dpkg-source patch make g++ autoconf automake pkg-config xz; do
        command -v $tool > /dev/null || missing+=" $tool"
    done
    for header in boost/thread.hpp boost/date_time.hpp zlib.h png.h jpeglib.h tiffio.h; do
        echo "#include <cstdio>
              #include <$header>" | g++ -E -x c++ - > /dev/null 2>&1 || missing+=" $header"
    done
    pkg-config --exists OpenEXR 2> /dev/null || missing+=" OpenEXR"
    [ -f /usr/share/povray-3.7/include/colors.inc ] || missing+=" povray-includes"
    [ -z "$missing" ] || fail "missing:$missing; install them with: apt-get install $(list_packages)"
}

# "URI KEYRING" with which this system gets the suite itself, from lists in deb822 form
deb822_source() {
    awk -v suite=$suite -v RS= '{
        split("", field)
        count = split($0, line, "\n")
        for (i = 1; i <= count; i++) {
            colon = index(line[i], ":")
            field[tolower(substr(line[i], 1, colon - 1))] = substr(line[i], colon + 1)
        }
        split(field["uris"], uri, " ")
        split(field["signed-by"], keyring, " ")
        if (field["types"] ~ /deb/ && (field["suites"] " ") ~ (" " suite " ")) {
            print uri[1], keyring[1]
            exit
        }
    }' "$@"
}

# the same, from lists in the classic form
classic_source() {
    awk -v suite=$suite '$1 == "deb" {
        keyring = ""
        if (match($0, /signed-by=[^] ]*/)) keyring = substr($0, RSTART + 10, RLENGTH - 10)
        sub(/\[[^]]*\] */, "")
        if ($3 == suite) { print $2, keyring; exit }
    }' "$@"
}

# Prints an apt source for the suite's source packages: from where this system gets the suite, or
# else from Debian.
apt_source() {
    local found uri keyring
    found=$(shopt -s nullglob
        deb822_source /etc/apt/sources.list.d/*.sources /dev/null
        classic_source /etc/apt/sources.list.d/*.list /dev/null
        [ ! -f /etc/apt/sources.list ] || classic_source /etc/apt/sources.list)
    read -r uri keyring <<< "$(head -n 1 <<< "$found")"
    case $uri in
    http* | file:* | copy:* | mirror*) ;;
    *) uri=http://deb.debian.org/debian ;;
    esac
    [ -n "$keyring" ] || keyring=/usr/share/keyrings/debian-archive-keyring.gpg
    printf 'Types: deb-src\nURIs: %s\nSuites: %s\nComponents: main\n' "$uri" $suite
    if [ -f "$keyring" ]; then printf 'Signed-By: %s\n' "$keyring"; fi
}

# Gets Debian's files into download/, with apt's checks but none of the system's lists.
download() {
    [ -f "$work/download/$dsc" ] && return
    command -v apt-get > /dev/null || fail "there is no apt-get to get POV-Ray's source package"
    say "downloading Debian's source package povray $version"
    local new=$work/download.new
    rm -rf "$new"
    mkdir -p "$new"/apt/{lists/partial,cache/archives/partial}
    apt_source > "$new/apt/povray.sources"
    local options=(-o "Dir::Etc::SourceList=$new/apt/povray.sources" -o Dir::Etc::SourceParts=-
        -o "Dir::State::Lists=$new/apt/lists" -o "Dir::Cache=$new/apt/cache"
        -o "APT::Sandbox::User=$(id -un)" -o APT::Update::Error-Mode=any -o Acquire::Retries=2)
    if ! (cd "$new" && apt-get "${options[@]}" update &&
        apt-get "${options[@]}" source --download-only "povray=$version") >> "$log" 2>&1; then
        end_line
        (fail "cannot download Debian's source package povray $version from" \
            "$(sed -n 's/^URIs: //p' "$new/apt/povray.sources"): see $log") || exit 75
    fi
    rm -rf "$new/apt" "$work/download"
    mv "$new" "$work/download"
}

# The patched tree in $1, ready for configure: debian/rules' steps without the documentation.
unpack() {
    local tree=$1 name
    logged "unpacking" dpkg-source --no-copy -x "$work/download/$dsc" "$tree"
    for file in "$here"/patches/*.patch; do
        logged "patch $(basename "$file")" patch -d "$tree" -p1 -F0 --forward -i "$file"
    done
    put_adapter "$tree"
    for file in "$tree"/unix/config/*.m4; do
        name=$(basename "$file")
        if [ ! -h "$file" ] && [ -f "/usr/share/aclocal/$name" ]; then
            ln -sf "/usr/share/aclocal/$name" "$file"
        fi
    done
    rm -rf "$tree"/{libraries,windows,doc,debian,.pc}
    (cd "$tree/unix" && logged "prebuild.sh" ./prebuild.sh)
}

# copy FROM TO: only where they differ, so that make sees what changed
copy() {
    cmp -s "$1" "$2" || cp "$1" "$2"
}

put_adapter() {
    local to=$1/source/backend/accel file
    mkdir -p "$to"
    for file in "$here"/source/backend/accel/*; do
        copy "$file" "$to/$(basename "$file")"
    done
    copy "$here/../accel/include/accel/accel.h" "$to/accel.h"
    copy "$build/libaccel.a" "$to/libaccel.a"
}

# What a tree is made of, apart from the contents of the adapter and the library.
recipe() {
    echo "$version ${configuration[*]}"
    cat "$here"/patches/*.patch
    ls "$here/source/backend/accel"
}

# Makes source/, unless it is there and made by the same recipe.
prepare_tree() {
    local sum
    sum=$(recipe | sha256sum)
    [ "$(cat "$work/source/recipe" 2> /dev/null)" = "$sum" ] && return
    check_tools
    download
    say "unpacking and patching"
    rm -rf "$work/source.new"
    unpack "$work/source.new"
    say "configuring"
    (cd "$work/source.new" && logged "configure" ./configure "${configuration[@]}")
    echo "$sum" > "$work/source.new/recipe"
    rm -rf "$work/source"
    mv "$work/source.new" "$work/source"
}

# Shows how far make is until it ends.
watch_make() {
    local files=$1 shown=-1 now
    while kill -0 "$make_pid" 2> /dev/null; do
        sleep 0.5
        now=$(grep -c ' -c -o ' "$log.make" || true)
        if [ "$now" != "$shown" ] && [ "$now" -le "$files" ] && { [ -t 1 ] || [ $((now % 20)) = 0 ]; }; then
            say "compiled $now of $files files"
            shown=$now
        fi
    done
}

compile() {
    local compiler=g++ files
    # a ccache that is there may still have no folder to write to
    if ccache g++ -x c++ -c /dev/null -o "$work/nothing.o" 2> /dev/null; then
        compiler="ccache g++"
    fi
    # unix/ has two more files, but make -n would name them every time
    files=$( (make -n -C "$work/source/source" && make -n -C "$work/source/vfe") 2> /dev/null |
        grep -c ' -c -o ' || true)
    make -C "$work/source" -j"$(nproc)" "CXX=$compiler" > "$log.make" 2>&1 &
    make_pid=$!
    trap 'kill $make_pid 2> /dev/null; end_line; exit 130' INT TERM
    if [ "$files" -gt 0 ]; then watch_make "$files"; fi
    if ! wait "$make_pid"; then
        end_line
        grep -a -E 'error|No space' "$log.make" | grep -v ' -c -o ' | head -n 10 >&2 || true
        fail "compiling failed: see $log.make"
    fi
    trap - INT TERM
}

install_binary() {
    if ! cmp -s "$work/source/unix/povray" "$build/povray-accel"; then
        cp "$work/source/unix/povray" "$build/povray-accel.new"
        mv "$build/povray-accel.new" "$build/povray-accel"
    fi
    say "$build/povray-accel is ready"
    end_line
}

if [ "${1-}" = --packages ]; then
    list_packages
    exit 0
fi
if [ $# -gt 1 ] || [[ ${1-} == -* ]]; then
    echo "usage: build.sh [BUILD_DIR] | --packages" >&2
    exit 2
fi
build=$(cd "${1-$here/../build}" 2> /dev/null && pwd) || fail "no folder ${1-$here/../build}"
[ -f "$build/libaccel.a" ] || fail "there is no $build/libaccel.a: build the library first (cmake)"
work=$build/povray
log=$work/build.log
mkdir -p "$work" 2> /dev/null || fail "cannot make the folder $work"
{ : >> "$log" && exec 9> "$work/lock"; } 2> /dev/null || fail "cannot write to $work"
flock 9
: > "$log"
prepare_tree
put_adapter "$work/source"
compile
install_binary
