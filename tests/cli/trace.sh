#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# accel trace and accel diff: every kind writes the same bytes; the camera is the one that the help
# describes; one changed bit is found; outputs appear whole or not at all; hostile files are refused.
# shellcheck source=tests/cli/common.sh
. "$(dirname "$0")/common.sh"

expect 0 trace teapots -o linear.exr -a linear --size 40x30
for each in $kinds; do
    expect 0 trace teapots -o kind.exr -a "$each" --size 40x30
    expect 0 diff linear.exr kind.exr
    says "1200 pixels, 15 channels: 0 pixels differ"
    cmp linear.exr kind.exr || fail "$each writes other bytes than linear"
done
expect 0 trace teapots -o threads.exr --size 40x30 --threads 3
cmp linear.exr threads.exr || fail "threads change the hits"

# Eye (0,0,4), looking at (0,0,0), 90 degrees, 4 x 2 pixels: h = tan(pi / 4), the columns' x are
# -3/4, -1/4, 1/4, 3/4 and the rows' y 1/4, -1/4, all times h; 'one' has x, y >= 0 and x + y <= 1.
expect 0 trace one -o one.exr --size 4x2 --camera 0,0,4:0,0,0:90
cat >rays.txt <<'RAYS'
0 0 4 0.25 0.25 -1
0 0 4 0.0625 0.125 -1
0,0,4,0.75,0.25,-1
RAYS
expect 0 trace one --rays rays.txt -o hits.txt
echo old >target.txt && ln -s target.txt link.txt
expect 0 trace one --rays rays.txt -o link.txt
[ -L link.txt ] && cmp -s hits.txt target.txt || fail "a link is not followed"
complains "--camera does not go with it" trace one --rays rays.txt -o x.txt --camera 0,0,5:0,0,0:40
complains "--size does not go with it" trace one --rays rays.txt -o x.txt --size 8x8
[ "$(cat hits.txt)" = "miss
0 0 4 0.25 0.5
miss" ] || fail "hits are $(cat hits.txt)"
expect 0 trace one -o far.exr --size 4x2 --camera 0,0,2:0,0,0:90
expect 1 diff one.exr far.exr
says "8 pixels, 15 channels: 1 pixels differ"
says "pixel (2, 0):"
grep -qE 'prim 4294967295 / 0  t inf / (2|1\.9999999999999998|2\.0000000000000004)( |$)' out ||
    fail "the only hit is not where it should be: $(cat out)"

# The difference image.
complains "does not end in .png" diff one.exr far.exr -o one.exr
expect 1 diff one.exr far.exr -o d.png
[ "$(head -c 4 d.png | tail -c 3)" = PNG ] || fail "the difference image is no PNG"
expect 0 diff one.exr one.exr -o same.png
cmp -s d.png same.png && fail "the difference image shows nothing"

# One bit: an uncompressed file of one pixel and one unsigned channel, written by hand.
write_exr() { # VALUE
    printf '\x76\x2f\x31\x01\x02\x00\x00\x00'
    printf 'channels\0chlist\0\x13\0\0\0p\0\0\0\0\0\0\0\0\0\x01\0\0\0\x01\0\0\0\0'
    printf 'compression\0compression\0\x01\0\0\0\0'
    printf 'dataWindow\0box2i\0\x10\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0'
    printf 'displayWindow\0box2i\0\x10\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0'
    printf 'lineOrder\0lineOrder\0\x01\0\0\0\0'
    printf 'pixelAspectRatio\0float\0\x04\0\0\0\0\0\x80\x3f'
    printf 'screenWindowCenter\0v2f\0\x08\0\0\0\0\0\0\0\0\0\0\0'
    printf 'screenWindowWidth\0float\0\x04\0\0\0\0\0\x80\x3f\0'
    printf '%b' "$offset"
    printf '\0\0\0\0\x04\0\0\0%b' "$1"
}
offset='\0\0\0\0\0\0\0\0'
header=$(($(write_exr '\0' | wc -c) - 9))
offset=$(printf '\\x%02x\\x%02x\\0\\0\\0\\0\\0\\0' $((header % 256)) $((header / 256)))
write_exr '\x04\0\0\0' >four.exr
write_exr '\x05\0\0\0' >five.exr
write_exr '\x04\0\0\x80' >high.exr
expect 0 diff four.exr four.exr
says "1 pixels, 1 channels: 0 pixels differ"
expect 1 diff four.exr five.exr
says "pixel (0, 0):  p 4 / 5"
expect 1 diff four.exr high.exr
says "p 4 / 2147483652"
complains "differ in size" diff one.exr linear.exr
expect 0 trace one -o tiny.exr --size 1x1
complains "differ in the number of channels" diff tiny.exr four.exr

# Hostile files.
complains "No such file or directory" diff one.exr missing.exr
complains "is a directory" diff . one.exr
: >empty.exr && complains "is empty" diff empty.exr one.exr
head -c 3000 /dev/zero >zero.exr && complains "nothing was loaded" diff zero.exr one.exr
size=$(stat -c %s one.exr)
for ((bytes = 1; bytes < size; bytes += 17)); do
    head -c "$bytes" one.exr >cut.exr
    complains "nothing was loaded" diff one.exr cut.exr
done
# a window of 2^30 x 1 pixels in some three hundred bytes
LC_ALL=C sed 's/\(dataWindow\x00box2i\x00\x10\x00\x00\x00\x00\x00\x00\x00\x00\x00\x00\x00\)..../\1\xff\xff\xff\x3f/' \
    four.exr >wide.exr
cmp -s four.exr wide.exr && fail "the hostile file is not hostile"
complains "nothing was loaded" diff wide.exr four.exr

# Outputs that cannot be written.
complains "cannot write missing/x.exr" trace one -o missing/x.exr
mkdir folder.exr && complains "it is a directory" trace one -o folder.exr
ln -s /dev/full full.exr && complains "No space left on device" trace one -o full.exr
ln -s /dev/full full.png && complains "No space left on device" trace one -o full.png
complains "No space left on device" trace one --rays rays.txt -o /dev/full
(
    ulimit -f 8
    trap '' XFSZ
    complains "File too large" trace teapots -o large.exr --size 200x200
    exit "$failures"
) || fail "a file size limit is not noticed"
echo "1 2 3" >>rays.txt
complains "rays.txt:4: '1 2 3' is no ray" trace one --rays rays.txt -o more.txt
cp one.exr kept.exr
complains "is no ray" trace one --rays rays.txt -o kept.exr
cmp one.exr kept.exr || fail "a failed run changes the file that was there"
if [ "$(id -u)" != 0 ]; then
    mkdir locked && chmod 500 locked
    complains "Permission denied" trace one -o locked/x.exr
fi

# Ctrl-C removes what is half done.
"$accel" trace teapots -o big.exr --size 8000x8000 --quiet &
pid=$!
for ((i = 0; i < 100; i++)); do
    compgen -G 'big.exr.*' >/dev/null && break
    sleep 0.05
done
kill -TERM "$pid"
wait "$pid" && fail "a killed run exits with 0"
compgen -G 'big.exr*' && fail "a killed run leaves a file behind"
finish
