#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# Files of rays as spreadsheets, editors and hands write them.
# shellcheck source=tests/cli/common.sh
. "$(dirname "$0")/common.sh"

printf '0.25 0.25 5 0 0 -1\n9 9 5 0 0 -1\n' >plain.txt
expect 0 trace one --rays plain.txt -o plain.hits
[ "$(cut -d' ' -f1-3 plain.hits | tr '\n' ' ')" = "0 0 5 miss " ] || fail "plain.txt: $(cat plain.hits)"

# same NAME CONTENT: the rays of plain.txt.
same() {
    printf '%b' "$2" >"$1.txt"
    expect 0 trace one --rays "$1.txt" -o "$1.hits"
    cmp plain.hits "$1.hits" || fail "$1.txt: $(cat "$1.hits")"
}

# wrong NAME LINE CONTENT: that line is refused, and shown as it is.
wrong() {
    printf '%b' "$3" >"$1.txt"
    complains "$1.txt:$2" trace one --rays "$1.txt" -o wrong.hits
}

one='0.25 0.25 5 0 0 -1' two='9 9 5 0 0 -1'
same blank_last "$one\n$two\n\n"
same blank_lines "\n\n$one\n \t \n$two\n\n\n"
same no_last_end "$one\n$two"
same comments "# two rays\n#\n$one # hits\n  # between\n$two#misses\n"
same header "ox oy oz dx dy dz\n$one\n$two\n"
same header_commas "ox,oy,oz,dx,dy,dz\n${one// /,}\n${two// /,}\n"
same header_quotes "\"origin x\";\"y\";\"z\";\"dx\";\"dy\";\"dz\"\n${one// /;}\n${two// /;}\n"
same header_late "# comment\n\nx y z dx dy dz\n$one\n$two\n"
same mark "\xef\xbb\xbf$one\n$two\n"
same mark_header "\xef\xbb\xbfox;oy;oz;dx;dy;dz\r\n${one// /;}\r\n${two// /;}\r\n"
same crlf "$one\r\n$two\r\n"
same cr "$one\r$two\r"
same semicolons "${one// /;}\n${two// /; }\n"
same commas "${one// /, }\n${two// / , }\n"
same tabs "${one// /\\t}\n\t${two// / \\t }\t\n"
same groups "0.25,0.25,5 0,0,-1\n9 9 5; 0 0 -1\n"
same groups_semicolon "0.25,0.25,5;0,0,-1\n9 9 5,0 0 -1\n"
same ends "${one// /,},\n${two// /;} ; \n"
same limits "$one 0 inf\n$two 0 9\n"
same skipped "$one 0 inf 4294967295 4294967295\n${two// /;};0;9;0;0\n"
same exact '0x1p-2 0.25 5 -0 0 -1\n9 9 5 0 0 -1e0\n'

wrong few "2: '1 2 3' is no ray; allowed is ox oy oz dx dy dz [tmin tmax [geom prim]]" "$one\n1 2 3\n"
wrong decimal_commas "1: '0,25 0,25 5 0 0 -1' is no ray" '0,25 0,25 5 0 0 -1\n'
wrong decimal_comma "1: '0,25 0 5 0 0' is no ray" '0,25 0 5 0 0\n'
wrong decimal_semicolons "1: '0,25;0,25;5;0;0;-1' is no ray" '0,25;0,25;5;0;0;-1\n'
wrong missing "1: '0.25,,5,0,0,-1' is no ray" '0.25,,5,0,0,-1\n'
wrong missing_more "2: '0.25,0.25,,5,0,0,-1' is no ray" "$one\n0.25,0.25,,5,0,0,-1\n"
wrong first "1: ',0.25,5,0,0,-1,3'" ',0.25,5,0,0,-1,3\n'
wrong two_ends "1: '0.25,0.25,5,0,0,-1,,'" '0.25,0.25,5,0,0,-1,,\n'
wrong late_header "2: 'ox oy oz dx dy dz' is no ray" "$one\nox oy oz dx dy dz\n"
wrong two_headers "2: 'a b c d e f' is no ray" "ox oy oz dx dy dz\na b c d e f\n$one\n"
wrong half_header "1: 'ox oy oz 0 0 1' is no ray" "ox oy oz 0 0 1\n$one\n"
wrong nul "2: '9?9 9 5 0 0 -1' is no ray" "$one\n9\x009 9 5 0 0 -1\n"
wrong nul_end "1: '$one?' is no ray" "$one\x00\n"
wrong words "1: '0.25 0.25 5 0 0 -1 x' is no ray" "$one x\n"
wrong escape "1: '1 2 ?[31m?3?' is no ray" '1 2 \x1b[31m\x9b3\x7f\n'
wrong not_utf8 "1: 'é ? ? ?( ??? € ?' is no ray" 'é \xff \xe9 \xc3( \xed\xa0\x80 € \xe2\x80\xae\n'
wrong cut "1: '$(printf 'é%.0s' {1..39}) ?' is no ray" "$(printf 'é%.0s' {1..39}) é\n"

# What is no ray that can be traced is told, with its first line.
printf '%s\nnan 0 1 0 0 -1\n0 0 1 0 0 0\n' "$one" >untraced.txt
expect 0 trace one --rays untraced.txt -o untraced.hits
grep -q '^accel trace: untraced.txt:2: 2 of 3 rays cannot be traced' err || fail "untraced: $(cat err)"
[ "$(cut -c 1-4 untraced.hits | tr '\n' ' ')" = "0 0  miss miss " ] || fail "untraced: $(cat untraced.hits)"

wrong none " holds no ray" '# nothing\n\n'
wrong only_header " holds no ray" 'ox oy oz dx dy dz\n'
finish
