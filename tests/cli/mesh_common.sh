# SPDX-License-Identifier: Apache-2.0
# shellcheck shell=bash
# For the tests of mesh files: sourced with the path of build/accel as first argument. Each case writes a file and says what is in it:
# the number of triangles and their box, or the words of the refusal.
# shellcheck source=tests/cli/common.sh
. "$(dirname "${BASH_SOURCE[0]}")/common.sh"

cases=0

# write NAME CONTENT: as printf's %b reads it.
write() {
    printf '%b' "$2" >"$1"
    cases=$((cases + 1))
}

# loads NAME TRIANGLES BOX CONTENT [NOTE]: the file has so many triangles and the box "x y z, x y z".
# Without NOTE nothing is said of it.
loads() {
    write "$1" "$4"
    check_loads "$1" "$2" "$3" "${5:-}"
}

check_loads() {
    local box="(${3%, *}) to (${3#*, })"
    expect 0 info "$1" -a linear
    grep -q "^$1: $2 primitives in .*, box $box" out ||
        fail "$1: '$(head -n 1 out)' instead of $2 triangles in $box $(cat err)"
    if [ -n "$4" ]; then
        grep -qF -e "note: $1: " err && grep -qF -e "$4" err || fail "$1: no note '$4': $(cat err)"
    elif [ -s err ]; then
        fail "$1: an unexpected note: $(cat err)"
    fi
}

# refuses NAME WORDS CONTENT: one line with the file's name and WORDS.
refuses() {
    write "$1" "$3"
    complains "$2" info "$1"
    grep -q "^accel info: $1[:,]" err || fail "$1 is not named first: $(cat err)"
    grep -q "; nothing was loaded$" err || fail "$1: what happened is not said: $(cat err)"
}

# little NUMBER..., big NUMBER...: 32-bit floats of these, as escapes for printf; whole ones with i
# in front.
little() { bytes_of 'V' "$@"; }
big() { bytes_of 'N' "$@"; }
bytes_of() {
    perl -e '$order = shift; print map { sprintf "\\x%02x", $_ } map {
        /^i(.*)/ ? unpack("C4", pack($order, $1 & 0xffffffff))
                 : unpack("C4", pack($order, unpack("L", pack("f", $_)))) } @ARGV' "$@"
}

finish_cases() {
    echo "$cases files"
    finish
}
