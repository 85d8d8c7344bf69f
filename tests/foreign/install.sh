#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# What `cmake --install` gives, in an empty prefix that is moved afterwards: strangers' programs
# in C and C++ by pkg-config and by find_package, with the static and the shared library.
#
#     install.sh HOST BUILD_FOLDER VERSION
# shellcheck source=tests/foreign/common.sh
. "$(dirname "${BASH_SOURCE[0]}")/common.sh"
build=$2 version=$3

quietly "cmake --install" cmake --install "$build" --prefix "$work/first"
mv "$work/first" "$work/prefix"
prefix=$work/prefix
library=$(dirname "$(find "$prefix" -name libaccel.a)")
pc=$library/pkgconfig/accel.pc
[ -f "$pc" ] || fail "no $pc"
[ "$(find "$prefix" -name '*.h' -printf '%P\n')" = include/accel/accel.h ] ||
    fail "headers: $(find "$prefix" -name '*.h')"

# The version is one, wherever it stands.
IFS=. read -r major minor _ <<<"$version"
soname=libaccel.so.$major.$minor
grep -qF "[$soname]" <<<"$(readelf -d "$library/libaccel.so")" || fail "the soname is not $soname"
[ -f "$library/libaccel.so.$version" ] || fail "no libaccel.so.$version"
[ "$(pkg-config --modversion "$pc")" = "$version" ] || fail "accel.pc is of another version"
grep -qx "version $version" "$work/expected" || fail "accel_version: $(head -n 1 "$work/expected")"
if [ -e "$build/accel" ]; then
    [ "$("$prefix/bin/accel" --version)" = "accel $version" ] || fail "bin/accel --version"
fi

# by_pkg_config COMPILER FILE: with both libraries.
by_pkg_config() {
    local compiler=$1 file=$here/$2 flags
    read -r -a flags <<<"$(pkg-config --cflags --libs "$pc")"
    quietly "$compiler by pkg-config" "$compiler" -O2 -Wall -Wextra -Wpedantic -Werror "$file" \
        -o "$work/host" "${flags[@]}"
    grep -q "NEEDED.*$soname" <<<"$(readelf -d "$work/host")" || fail "the shared library is not taken"
    same_answers "$compiler by pkg-config, shared" env "LD_LIBRARY_PATH=$library" "$work/host"
    read -r -a flags <<<"$(pkg-config --static --cflags --libs "$pc")"
    quietly "$compiler by pkg-config --static" "$compiler" -O2 -static "$file" -o "$work/host" \
        "${flags[@]}"
    same_answers "$compiler by pkg-config, static" "$work/host"
}
by_pkg_config cc host.c
by_pkg_config c++ host.cpp

for language in C CXX; do
    for shared in OFF ON; do
        stranger "find_package in $language, BUILD_SHARED_LIBS=$shared" "$language" \
            "-DCMAKE_PREFIX_PATH=$prefix" "-DVERSION=$version" "-DBUILD_SHARED_LIBS=$shared"
    done
done
if cmake -S "$here/stranger" -B "$work/newer" -DLANGUAGE=C "-DCMAKE_PREFIX_PATH=$prefix" \
    "-DVERSION=$major.$((minor + 1))" >"$work/log" 2>&1; then
    fail "find_package takes $version for $major.$((minor + 1))"
fi
