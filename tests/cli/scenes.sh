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
for command in "check mixed.obj -n 100" "trace mixed.obj -o mixed.exr --size 8x8" "export mixed.obj -o mixed.inc"; do
    # shellcheck disable=SC2086
    expect 0 $command
    grep -q "note: mixed.obj: 1 points and lines are left out$" err || fail "$command does not tell what is left out"
done

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

# What assimp reads is said to be unchecked; lines are left out there too, and matrices are in double.
cat >two.dae <<'DAE'
<?xml version="1.0"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
<asset><up_axis>Y_UP</up_axis></asset>
<library_geometries><geometry id="g"><mesh>
<source id="p"><float_array id="a" count="9">0 0 0 1 0 0 0 1 0</float_array><technique_common>
<accessor source="#a" count="3" stride="3"><param name="X" type="float"/><param name="Y" type="float"/>
<param name="Z" type="float"/></accessor></technique_common></source>
<vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
<triangles count="1"><input semantic="VERTEX" source="#v" offset="0"/><p>0 1 2</p></triangles>
<lines count="2"><input semantic="VERTEX" source="#v" offset="0"/><p>0 1 1 2</p></lines>
</mesh></geometry></library_geometries>
<library_visual_scenes><visual_scene id="s"><node><instance_geometry url="#g"/></node>
<node><translate>10 0 0</translate><instance_geometry url="#g"/></node></visual_scene></library_visual_scenes>
<scene><instance_visual_scene url="#s"/></scene></COLLADA>
DAE
expect 0 info two.dae -a linear
says "two.dae: 2 primitives in 2 geometries, box (0 0 0) to (11 1 0); 4 points and lines left out"
grep -q "note: two.dae: 4 points and lines are left out; is read by assimp, unchecked" err ||
    fail "two.dae is not said to be unchecked: $(cat err)"
expect 0 export two.dae -o two.inc

# A mesh without any triangle that a ray can hit is no error; a NaN is skipped and counted.
sed 's/\x00\x00\x80\x3f/\x00\x00\xc0\x7f/' binary.ply >nan.ply
expect 0 info nan.ply -a linear
says "3 invalid primitives, first (geometry/primitive) 0/0 0/1 0/3"
expect 0 check nan.ply -a grid -a bvh -n 100
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
