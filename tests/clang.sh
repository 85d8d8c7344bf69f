#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# Do library and command compile with clang without a warning, and trace the same bits as gcc's?
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
build=$root/build
other=$build/clang
log=$build/clang.log

fail() {
    printf 'clang.sh: %s\n' "$*"
    exit 1
}

cmake -S "$root" -B "$other" -DCMAKE_C_COMPILER=clang -DCMAKE_CXX_COMPILER=clang++ \
    -DCMAKE_BUILD_TYPE=Release -DACCEL_TESTS=OFF -DACCEL_WERROR=ON >"$log" 2>&1 ||
    { tail -n 20 "$log" && fail "cmake failed: $log"; }
cmake --build "$other" >"$log" 2>&1 ||
    { grep -A 5 -E 'error|warning' "$log" && fail "clang complains: $log"; }

mapfile -t kinds < <("$build/accel" kinds | awk '!NF { block++ } block == 1 && /^[a-z]/ { print $1 }')
[ "${#kinds[@]}" -gt 1 ] || fail "$build/accel names no kinds"
trace=(trace teapots:quads=3 --size 96x64 --quiet)
failed=0
for kind in "${kinds[@]}"; do
    "$build/accel" "${trace[@]}" -a "$kind" -o "$other/gcc.exr"
    "$other/accel" "${trace[@]}" -a "$kind" -o "$other/clang.exr"
    printf '%s: ' "$kind"
    "$build/accel" diff "$other/gcc.exr" "$other/clang.exr" || failed=1
done
exit "$failed"
