#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# Every input that is no scene: one clear line, exit code 2, nothing written.
# shellcheck source=tests/cli/common.sh
. "$(dirname "$0")/common.sh"
write_meshes

complains "No such file or directory" info missing.ply
complains "neither a file nor a built-in scene" info missing
complains "scene '' is neither a file nor a built-in scene" info ""
complains "min=2 is above max=1 (the default);" info soup:min=2
complains "min=2 is above max=1;" info soup:min=2,max=1
complains "min=0.5 is above max=0.1;" info spheres:max=0.1,min=0.5
mkdir folder.ply && complains "is a directory" info folder.ply
mkfifo pipe.ply && complains "is not a regular file" info pipe.ply
: >empty.ply && complains "is empty" info empty.ply
if [ "$(id -u)" != 0 ]; then
    cp text.ply locked.ply && chmod 0 locked.ply
    complains "Permission denied" info locked.ply
fi
head -c 100 /dev/urandom >noise.obj && complains "nothing was loaded" info noise.obj
head -c 4000 /dev/zero >zero.ply && complains "allowed is 'ply'" info zero.ply
echo "not a mesh" >file.xyz && complains "nothing was loaded" info file.xyz

# Truncated: every prefix is either refused or lacks nothing but the last line's end.
for mesh in text.ply binary.ply text.off text.stl; do
    size=$(stat -c %s "$mesh")
    for ((bytes = 1; bytes < size - 1; bytes += 5)); do
        head -c "$bytes" "$mesh" >"cut.${mesh#*.}"
        got=0
        timeout 60 "$accel" info "cut.${mesh#*.}" -a linear >out 2>err || got=$?
        lines=$(wc -l <err)
        if [ "$got" != 2 ] || [ "$lines" != 1 ] || [ -s out ]; then
            # text cannot show that its last number lost digits or its last word letters
            [ "$mesh" != binary.ply ] && [ "$got" = 0 ] && [ $((size - bytes)) -le 3 ] ||
                fail "$bytes bytes of $mesh: exit code $got, $lines lines"
        fi
    done
done
printf 'v 0 0 0\nv 1 0 0\nv 0 1' >cut.obj
complains "cut.obj:3: a vertex of 2 numbers" info cut.obj
printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2' >face.obj
complains "face.obj:4: a face of 2 corners" info face.obj

# Hostile counts and indices.
for count in 2147483647 4294967295; do
    sed "s/element vertex 4/element vertex $count/" text.ply >count.ply
    complains "PLY header promises $count of element 'vertex'" info count.ply
    sed "s/element face 4/element face $count/" text.ply >count.ply
    complains "PLY header promises $count of element 'face'" info count.ply
    sed "s/^4 4 0/$count 4 0/" text.off >count.off
    complains "OFF header promises $count vertices" info count.off
done
for count in 5 18446744073709551615; do
    sed "s/element vertex 4/element vertex $count/" text.ply >count.ply
    complains "count.ply:" info count.ply
    sed "s/element face 4/element face $count/" text.ply >count.ply
    complains "count.ply:" info count.ply
    sed "s/^4 4 0/$count 4 0/" text.off >count.off
    complains "count.off:" info count.off
done
sed 's/element vertex 4/element vertex -1/' text.ply >count.ply
complains "count.ply:3: found '-1'" info count.ply
sed 's/property list uchar int/property list uchar toast/' text.ply >count.ply
complains "count.ply:8: found 'toast', allowed is a type" info count.ply
sed 's/^3 1 2 3/3 1 2 99999/' text.ply >index.ply
complains "a face refers to vertex 99999, but the file has 4" info index.ply
sed 's/^3 1 2 3/3 1 2 -1/' text.ply >index.ply
complains "found -1, allowed is the number of a vertex" info index.ply
for corner in 4 99999 -1; do
    sed "s/^3 1 2 3/3 1 2 $corner/" text.off >index.off
    complains "a face refers to vertex $corner, but the file has 4" info index.off
done
sed 's/^f 2 3 4/f 2 3 99999/' text.obj >index.obj
complains "nothing was loaded" info index.obj
{
    head -c 80 /dev/zero
    printf '\377\377\377\377'
    head -c 50 /dev/zero
} >count.stl
complains "STL header promises 4294967295 triangles" info count.stl

# Meshes without triangles.
sed 's/element face 4/element face 0/; /^3 /d' text.ply >points.ply
complains "holds no triangle" info points.ply
printf 'v 0 0 0\nv 1 0 0\nl 1 2\np 1\n' >lines.obj
complains "holds no triangle" info lines.obj

# The other subcommands load in the same way.
complains "No such file or directory" check missing.ply
complains "No such file or directory" trace missing.ply -o x.exr
complains "found 'toast', allowed is a type" trace count.ply -o x.exr
complains "othing was built" check one -a nokind
complains "othing was built" trace one -o x.exr -a nokind

# A complaint is one line whatever a name or a file holds.
complains "No such file or directory" info $'new\nline\e[2J.ply'
printf 'v \033[2J 0 0\nf 1 1 1\n' >escape.obj
expect 2 info escape.obj
[ "$(tr -d '[:print:]\n' <err | wc -c)" = 0 ] || fail "a complaint holds the file's control bytes"
finish
