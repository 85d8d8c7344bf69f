#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# Help, usage lines, unknown words, and the tables that accel kinds prints.
# shellcheck source=tests/cli/common.sh
. "$(dirname "$0")/common.sh"

expect 0 --help
says "usage: accel COMMAND"
for command in kinds info check trace diff export; do
    grep -qE "^  $command " <<<"$("$accel" --help)" || fail "accel --help does not list $command"
    expect 0 "$command" --help
    says "usage: accel $command"
    says "--quiet"
    complains "nearest is --quiet" "$command" --quite
done
expect 0 --help
says "OBJ, PLY, STL, OFF and glTF 2.0 (.gltf, .glb) are read strictly"
expect 0 info --help
says "Other formats are read by assimp, unchecked"
expect 0 --version
complains "usage: accel COMMAND"
complains "nearest is check" chekc
complains "unknown option -z" info -z
complains "needs a value: CONFIG" info one -a
complains "takes no value" info one --quiet=1

# What is far from every legal word is not likened to one.
for words in xyzzy "info xyzzy" "info one --xyzzy" "info one -a xyzzy" "info cubes:xyzzy=1"; do
    # shellcheck disable=SC2086
    complains xyzzy $words
    ! grep -qE "nearest|did you mean" err || fail "accel $words: $(cat err)"
done

# Of two values of an option none is dropped without a word; a list of them is taken.
complains "--accelerator is given twice" lazy one -a "$kind" -a linear
complains "--accelerator is given twice" trace one -o x.exr -a linear --accelerator linear
complains "--output is given twice" trace one -o x.exr -o y.exr
complains "--size is given twice" trace one -o x.exr --size 8x8 --size=9x9
complains "--csv is given twice" bench one --csv a.csv --csv b.csv
expect 0 info one -a linear -a "$kind" -q -q
complains "no SCENE is given; usage: accel info" info
complains "no SCENE is given; usage: accel check" check
complains "SCENE and -o FILE are needed" trace one
complains "two files are needed" diff a.exr
complains "unexpected 'two'" info one two
complains "unexpected 'x'" kinds x

complains "did you mean '$kind'" info one -a "${kind}x"
key=$("$accel" kinds | sed "1,/^$kind /d; /^[a-zB]/,\$d" | sed -n 's/^    \([a-z]*\)=.*/\1/p' | head -n 1)
if [ -n "$key" ]; then
    complains "did you mean '$key'" info one -a "$kind:x$key=3"
    complains "$key" info one -a "$kind:$key=-1"
fi
complains "did you mean '$kind'" info one -a "${kind^^}"
complains "nearest is check" CHECK
complains "nearest is --quiet" info one --Quiet
complains "nearest is teapots" info Teapots
complains "nearest is teapots" info teapot
complains "nearest is gap" info cubes:gop=1
complains "gap=2 is given twice" info cubes:gap=1,gap=2
complains "allowed is one number from 0 to 1000000" info cubes:gap=-1
complains "allowed is one whole number" info soup:n=1.5
complains "n=x is out of range" info soup:n=x
complains "n= is out of range" info soup:n
complains "it has none" info one:n=1
complains "nearest is seed" info slivers:sed=1
complains "--rays is '0'" check one --rays 0
complains "--rays is '1e3'" check one --rays 1e3
complains "--seed is '-1'" check one --seed -1
complains "is no ray" check one --ray "0 0 0 0 0"
complains "is no ray" check one --ray "0 0 0 0 0 x"
complains "WxH" trace one -o x.exr --size 0x10
complains "WxH" trace one -o x.exr --size 65536x65536
complains "is no camera" trace one -o x.exr --camera 0,0,0:0,0,0:40
complains "is no camera" trace one -o x.exr --camera 0,0,1:0,0,0:180
complains "is no camera" trace one -o x.exr --camera 0,0,1
complains "neither .exr nor .png" trace one -o x.jpg

# Every kind, every option and every built-in scene that kinds lists can be used.
expect 0 kinds
says "linear"
cp out kinds.txt
for each in $kinds; do
    expect 0 info cubes -a "$each"
    says "build time"
done
[ -z "$(sed '1,/^Built-in/d' kinds.txt | grep -oE '^[^ ]+ ' | sort | uniq -d)" ] || fail "two scenes have one name"
for scene in $(sed '1,/^Built-in/d' kinds.txt | grep -oE '^[a-z]+ ' | tr -d ' '); do
    expect 0 info "$scene" -a linear
    says "primitives in"
done

got=0
"$accel" kinds >/dev/full 2>err || got=$?
[ "$got" = 2 ] || fail "accel kinds to a full device exits with $got"

# Closed standard output: an error, and no file gets what was to be printed.
got=0
"$accel" bench one -n 10 --repeats 1 --csv figures.csv >&- 2>err || got=$?
[ "$got" = 2 ] && grep -q "cannot write the output" err ||
    fail "accel bench with its output closed exits with $got: $(cat err)"
! grep -q "every answer" figures.csv || fail "what was to be printed is in the file of figures"
finish
