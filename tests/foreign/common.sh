# SPDX-License-Identifier: Apache-2.0
# shellcheck shell=bash
# For the tests of strangers' projects: sourced with the program `host` of the build that is tested
# as first argument.
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
# shellcheck source=tests/scratch.sh
. "$here/../scratch.sh"
"$1" >"$work/expected"

# same_answers WHAT PROGRAM...: the program gives the bits of the build that is tested.
same_answers() {
    local what=$1
    shift
    "$@" >"$work/found" 2>&1 || fail "$what: $(tail -n 3 "$work/found")"
    diff "$work/expected" "$work/found" >&2 || fail "$what: other answers (<: expected)"
    printf '%s: the same answers\n' "$what"
}

# stranger WHAT LANGUAGE CMAKE-ARGUMENT...: builds the stranger's project, compares its answers.
stranger() {
    local what=$1 folder
    folder=$(mktemp -d "$work/stranger.XXXXXX")
    quietly "$what: cmake" cmake -S "$here/stranger" -B "$folder" "-DLANGUAGE=$2" "${@:3}"
    quietly "$what: build" cmake --build "$folder"
    same_answers "$what" "$folder/host"
}
