#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# Mesh files of every format give the triangles that are in them, in their order, and the built-in
# scenes what they promise.
# shellcheck source=tests/cli/common.sh
. "$(dirname "$0")/common.sh"
write_meshes

# The same rays must meet the same triangles whatever the format.
cat >rays.txt <<'RAYS'
0.25 0.2 -1 0 0 1
0.25 -1 0.2 0 1 0
-1,0.25,0.2,1,0,0
1 1 1 -1 -1 -1.25
0.3 0.3 5 0 0 1
RAYS
for mesh in text.ply binary.ply text.off text.obj text.stl; do
    expect 0 info "$mesh" -a linear
    says "$mesh: 4 primitives in 1 geometries, box (0 0 0) to (1 1 1)"
    expect 0 trace "$mesh" --rays rays.txt -o "$mesh.hits"
    cmp text.ply.hits "$mesh.hits" || fail "$mesh has other hits than text.ply"
done
[ "$(cut -d' ' -f1-3 text.ply.hits | tr '\n' ',')" = "0 0 1,0 1 1,0 2 1,0 3 $(
    cut -d' ' -f3 <(sed -n 4p text.ply.hits)),miss," ] || fail "hits are $(cat text.ply.hits)"

# Comments and empty lines within an OFF file are no faces.
sed '/^3 0 1 3/i # four faces\n\n   # of three corners' text.off | sed 's/^3 0 2 3/& # the third/' >remarks.off
expect 0 trace remarks.off --rays rays.txt -o remarks.hits
cmp text.ply.hits remarks.hits || fail "comments change an OFF file"

# A polygon is cut in place; lines and points are left out and counted.
printf 'v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 2 2 2\nf 1 2 3 4\nl 1 2\nf 1 2 5\n' >mixed.obj
expect 0 info mixed.obj -a linear
says "3 primitives"
says "1 points and lines left out"

# A glTF: a buffer beside it, two nodes with the same mesh, one of them moved and scaled in double.
{
    printf '\0\0\0\0\0\0\0\0\0\0\0\0\0\0\200\077\0\0\0\0\0\0\0\0\0\0\0\0\0\0\200\077\0\0\0\0'
    printf '\0\0\1\0\2\0'
} >buffer.bin
cat >two.gltf <<'GLTF'
{"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0,1]}],
"nodes":[{"mesh":0},{"mesh":0,"translation":[10,0,0],"scale":[2,2,2]}],
"meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1}]}],
"accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],
"max":[1,1,0]},{"bufferView":1,"componentType":5123,"count":3,"type":"SCALAR"}],
"bufferViews":[{"buffer":0,"byteLength":36},{"buffer":0,"byteOffset":36,"byteLength":6}],
"buffers":[{"byteLength":42,"uri":"buffer.bin"}]}
GLTF
expect 0 info two.gltf -a linear
says "2 primitives in 2 geometries, box (0 0 0) to (12 2 0)"
mkdir elsewhere && mv buffer.bin elsewhere
sed 's,buffer.bin,elsewhere/buffer.bin,' two.gltf >other.gltf
complains "elsewhere/buffer.bin" info other.gltf
sed "s,buffer.bin,$work/elsewhere/buffer.bin," two.gltf >absolute.gltf
complains "buffer.bin" info absolute.gltf

# A mesh without any triangle that a ray can hit is no error; a NaN is skipped and counted.
sed 's/^1 0 0$/nan 0 0/' text.off >nan.off
expect 0 info nan.off -a linear
says "3 invalid primitives, first (geometry/primitive) 0/0 0/1 0/3"
expect 0 check nan.off -a grid -a bvh -n 100
[ "$(grep -c 'warning: 3 of .* the first is geometry 0, primitive 0$' err)" = 1 ] ||
    fail "no warning, or more than one, of what is skipped: $(cat err)"

expect 0 info cubes:gap=2 -a linear
says "cubes:gap=2: 12288 primitives in 1 geometries, box (0 0 0) to (60 15 15)"
expect 0 info teapots -a linear
says "49370 primitives in 10 geometries"
says " 0 triangles that no ray can hit"
expect 0 info stadium -a linear
says "104680 primitives"
expect 0 info soup:n=1000 -a linear
says "1000 primitives"
expect 0 info same:n=300 -a linear
says "300 primitives"
expect 0 info empty -a linear
says "0 primitives"

# Scenes come from their names alone.
expect 0 trace soup:n=1000,seed=7 -o a.exr --size 64x48
expect 0 trace soup:n=1000,seed=7 -o b.exr --size 64x48
cmp a.exr b.exr || fail "the same scene twice gives other hits"
expect 0 trace soup:n=1000,seed=8 -o c.exr --size 64x48
expect 1 diff a.exr c.exr
finish
