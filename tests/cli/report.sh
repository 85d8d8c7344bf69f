#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# accel report with the least counts: files, columns and rows, no wrong answer of ours, plots that
# are XML, and a folder that appears whole or not at all. That a broken structure would show is the
# test report_exam.c.
programs=$(cd "$(dirname "$0")/../../accel/cli/report/plots" && pwd)
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

"$accel" report -o page --minutes 0 --quiet >out 2>err || fail "report: $(cat err)"
says "0 wrong"
[ "$(find . -maxdepth 1 -name 'page*' | wc -l)" = 1 ] || fail "a temporary folder is left"

forms=$(grep -vc '^auto' <<<"$kinds")
has exact.csv "scene,contender,peer,input,judge,primitives,rays,decided,wrong,share,shown,ns_per_ray,build_seconds,seconds_with_build" "$((12 * forms))"
awk -F, 'NR > 1 && $3 == 0 && ($9 != 0 || $8 == 0) { exit 1 }' page/exact.csv ||
    fail "an answer of ours is wrong in exact.csv, or none was judged"
for each in $kinds; do
    [ "$(grep -c ",$each,0,given," page/exact.csv)" = 12 ] || fail "$each is not on every scene"
done

has cases.csv "test,case,scene,judge,contender,peer,rays,decided,wrong,decided_rounded,wrong_rounded,ns_per_ray,cost" "$((60 * forms))"
awk -F, 'NR > 1 && $6 == 0 && ($9 != 0 || $7 == 0) { exit 1 }' page/cases.csv ||
    fail "an answer of ours is wrong in cases.csv, or none was judged"
for test in sizes scales offsets slivers reported degenerate coincident nested series lattice closed \
    speck huge-and-tiny ties few special-rays surface-origins interval-ends direction-lengths \
    secondary-rays odd-objects; do
    for each in $kinds; do
        grep -qE "^$test,.*,$each,0," page/cases.csv || fail "$test is not asked of $each"
    done
    grep -q "<th colspan=\"8\">$test: " page/index.html || fail "$test is not in the table"
done

if [ "$kind" = linear ]; then
    grep -q "no structure but linear search" page/index.html || fail "the page does not say so"
    finish
    exit
fi
timed=$(grep -vcx linear <<<"$kinds")
has light.csv "scene,estimator,radius,photons,seeds,structure,build_seconds,photon_seconds,estimate_seconds,seconds,rmse,bias,bias_seen,floor,hash" "$((2 * 2 * 4 * timed))"
for scene in plates teapots; do
    for photons in 1000 10000; do
        awk -F, -v s=$scene -v n=$photons '$1 == s && $4 == n { rows++; hash[$15]; if (!($5 >= 16 &&
            $10 > 0 && $11 > 0)) bad = 1 } END { for (h in hash) hashes++
            exit !(rows > 0 && hashes == 1 && !bad) }' page/light.csv ||
            fail "$scene with $photons photons: not one hash for all, or fewer than 16 seeds"
    done
done
# noise falls with the root of the number of photons: by 3.16 for ten times as many
awk -F, '$1 == "plates" && $2 == "paths" && $6 == "auto" { e[$4] += $11 }
    END { f = e[1000] / e[10000]; exit !(f > 2.5 && f < 4) }' page/light.csv ||
    fail "the error does not fall as noise does"

has choice.csv "scene,panel,kind,option,position,value,config,rays,wrong,share,shown,ns_per_ray,build_seconds,seconds_with_build,nodes,tests,bytes" 2
has size.csv "scene,primitives,contender,peer,rays,wrong,ns_per_ray,nodes,tests,build_seconds,seconds_with_build,bytes_per_primitive" "$((2 * forms))"
has gap.csv "scene,gap,contender,peer,rays,wrong,ns_per_ray,nodes,tests,build_seconds,seconds_with_build,bytes_per_primitive" "$((6 * (forms - 1)))"
awk -F, 'NR > 1 && ($9 != 0 || $8 < 100) { exit 1 }' page/choice.csv ||
    fail "an answer of ours is wrong in choice.csv, or few were judged"
for file in size gap; do
    awk -F, 'NR > 1 && $4 == 0 && ($6 != 0 || $5 < 100) { exit 1 }' page/$file.csv ||
        fail "an answer of ours is wrong in $file.csv, or few were judged"
done
for each in $kinds; do
    case $each in linear | bvh) continue ;; esac # they have no options to choose
    [ "$(grep -c ",$each,.*,0,auto," page/choice.csv)" -ge 2 ] ||
        fail "what $each chooses by itself is not in choice.csv"
    [ "$(grep -c ",$each,0," page/size.csv)" -ge 2 ] || fail "$each is not in size.csv"
done

plots=$(find page -name '*.svg' | sort)
[ "$(wc -l <<<"$plots")" = 9 ] || fail "only these plots: $plots"
for plot in $plots page/index.html; do
    xmllint --noout "$plot" 2>xml || fail "$plot is no XML: $(head -n 1 xml)"
done
! grep -q '{{' page/index.html || fail "a gap of the page is left"
# Columns by name only: a new one must not shift a plot.
! grep -nE '\$[0-9]|col(umn)?\([0-9]|using [^(]*[0-9]+:' "$programs"/*.gnuplot ||
    fail "a plot calls a column by its number"
for plot in $plots; do
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

# Ended by a signal it leaves nothing.
got=0
timeout -s TERM 2 "$accel" report -o ended --minutes 5 --quiet >out 2>err || got=$?
[ "$got" = 124 ] || fail "ended by a signal it exits with $got: $(cat err)"
[ "$(find . -maxdepth 1 -name 'ended*' | wc -l)" = 0 ] || fail "ended by a signal it leaves a folder"

# A second report takes the place of the first, but never of a file that no report has made.
echo mine >page/notes.txt
complains "holds 'notes.txt', which no report has made" report -o page
[ "$(cat page/notes.txt)" = mine ] && [ -e page/cases.csv ] || fail "page has changed"
rm page/notes.txt
mkdir page/more && complains "holds 'more'" report -o page/ && rmdir page/more
expect 0 report -o page/ --minutes 0 --only exact --quiet
[ -e page/exact.csv ] && [ ! -e page/cases.csv ] || fail "the former report is not replaced"
(
    sleep 1
    echo late >page/late.txt
) &
expect 2 report -o page --minutes 0.1 --only exact --quiet
grep -q "holds 'late.txt'" err && [ "$(cat page/late.txt)" = late ] || fail "a file of the user's is gone"

# The folder that is there stays, with its mode; links are in outputs.c.
mkdir -m 700 real
(cd real && "$accel" report -o . --minutes 0 --only exact --quiet >../out 2>../err) ||
    fail "no report in the working folder: $(cat err)"
[ "$(stat -c %a real)" = 700 ] && [ "$(ls real | xargs)" = \
    "exact-build.svg exact-far.svg exact.csv exact.svg index.html" ] ||
    fail "the folder of mode $(stat -c %a real) holds $(ls real | xargs)"
complains "holds no report" report -o real/..
complains "holds no report" report -o /proc
mkfifo pipe && complains "it is a file, not a folder" report -o pipe
complains "it is a file, not a folder" report -o -
complains "the name is empty" report -o ""
[ "$(find . -maxdepth 1 -name 'page*' | wc -l)" = 1 ] || fail "a temporary folder is left"
finish
