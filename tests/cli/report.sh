#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# accel report with the least counts: files, columns and rows, no wrong answer of ours, plots that
# are XML, and a folder that appears whole or not at all. That a broken structure would show is the
# test report_exam.c.
# shellcheck source=tests/cli/common.sh
. "$(dirname "$0")/common.sh"

# has FILE COLUMNS ROWS: a file of figures with these columns and at least so many full rows.
has() {
    local file=page/$1 rows
    [ "$(head -n 1 "$file")" = "$2" ] || fail "$1 has the columns '$(head -n 1 "$file")'"
    rows=$(awk -F, 'NR == 1 { n = NF } NR > 1 && NF == n && !/,,/' "$file" | wc -l)
    [ "$rows" = "$(($(wc -l <"$file") - 1))" ] || fail "$1 has a row with other columns"
    [ "$rows" -ge "$3" ] || fail "$1 has $rows rows, not $3"
}

complains "no -o DIR is given" report
complains "allowed is a number from 0 to 1440" report -o page --minutes x
complains "--only is" report -o page --only nosuch
complains "No such file or directory" report -o no/such/page
: >file
complains "it is a file, not a folder" report -o file
mkdir full
: >full/thing
complains "holds no report" report -o full
got=0
PATH=$work/nowhere "$accel" report -o page >out 2>err || got=$?
[ "$got" = 2 ] && grep -q "gnuplot cannot be run" err && [ "$(wc -l <err)" = 1 ] ||
    fail "without gnuplot it exits with $got and says $(cat err)"
[ ! -e page ] || fail "without gnuplot it leaves a folder"

timeout 300 "$accel" report -o page --minutes 0 --quiet >out 2>err || fail "report: $(cat err)"
says "0 wrong"
[ "$(find . -maxdepth 1 -name 'page*' | wc -l)" = 1 ] || fail "a temporary folder is left"

forms=$(grep -vc '^auto' <<<"$kinds")
has exact.csv "scene,contender,peer,input,judge,primitives,rays,decided,wrong,share,shown,ns_per_ray,build_seconds,seconds_with_build" "$((12 * forms))"
awk -F, 'NR > 1 && $3 == 0 && ($9 != 0 || $8 == 0) { exit 1 }' page/exact.csv ||
    fail "an answer of ours is wrong in exact.csv, or none was judged"
for each in $kinds; do
    [ "$(grep -c ",$each,0,given," page/exact.csv)" = 12 ] || fail "$each is not on every scene"
done

plots=$(find page -name '*.svg' | sort)
[ "$(wc -l <<<"$plots")" -ge 3 ] || fail "only these plots: $plots"
for plot in $plots; do
    python3 - "$plot" <<'PYTHON' || fail "$plot is no XML"
import sys, xml.etree.ElementTree
xml.etree.ElementTree.parse(sys.argv[1])
PYTHON
    grep -q "id=\"$(basename "$plot" .svg)\"" page/index.html || fail "$plot is not on the page"
    [ "$(grep -c '<use ' "$plot")" -gt 3 ] || fail "$plot is empty"
done
for part in $(grep -o '<h2 id="[a-z]*"' page/index.html | cut -d'"' -f2); do
    sed -n "/<h2 id=\"$part\"/,/<h2/p" page/index.html | grep -cE '<svg|<table' >/dev/null ||
        fail "the part $part is empty"
done
for file in page/*.csv; do
    grep -q "\"$(basename "$file")\"" page/index.html || fail "$file is not on the page"
done

# A second report takes the place of the first.
: >page/old
expect 0 report -o page --minutes 0 --only exact --quiet
[ ! -e page/old ] || fail "the former report is not replaced"
[ "$(find . -maxdepth 1 -name 'page*' | wc -l)" = 1 ] || fail "a temporary folder is left"
finish
