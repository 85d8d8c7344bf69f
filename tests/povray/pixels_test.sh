#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
#
# Judges the judge of pictures: how many pixels does different_pixels find?
set -euo pipefail
# shellcheck source=tests/povray/common.sh
. "$(dirname "${BASH_SOURCE[0]}")/common.sh"

out=$(mktemp -d)
trap 'rm -rf "$out"' EXIT
cd "$out"
failed=0

# expect COUNT A.ppm B.ppm WHAT
expect() {
    local found
    found=$(different_pixels "$2" "$3" 4x3)
    if [ "$found" = "$1" ]; then
        echo "ok      $4: $1"
    else
        echo "FAILED  $4: $found, not $1"
        failed=1
    fi
}

# picture FILE BYTES: a header, and as many bytes of pixels, all the same
picture() {
    { printf 'P6\n# rendered by a test\n4 3\n65535\n' && printf 'x%.0s' $(seq "$2"); } >"$1"
}

picture one.ppm 72
picture same.ppm 72
picture short.ppm 20
: >empty.ppm
# the last byte of the third pixel
sed '$s/^\(x\{17\}\)x/\1y/' one.ppm >other.ppm
expect 0 one.ppm same.ppm "the same picture"
expect 1 one.ppm other.ppm "one pixel"
expect 12 one.ppm missing.ppm "no second picture"
expect 12 missing.ppm one.ppm "no first picture"
expect 12 missing.ppm missing.ppm "no picture at all"
expect 12 one.ppm empty.ppm "an empty picture"
expect 12 one.ppm short.ppm "half a picture"
exit $failed
