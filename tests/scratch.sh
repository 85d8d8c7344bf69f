# SPDX-License-Identifier: Apache-2.0
# shellcheck shell=bash
# Sourced by tests that work in a folder of their own, $work, which is removed at the end.
set -euo pipefail
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

fail() {
    printf 'FAIL: %s\n' "$*" >&2
    exit 1
}

# quietly WHAT COMMAND...: shows the end of what a command prints only where it fails.
quietly() {
    local what=$1
    shift
    "$@" >"$work/log" 2>&1 || { tail -n 20 "$work/log" >&2 && fail "$what"; }
}
