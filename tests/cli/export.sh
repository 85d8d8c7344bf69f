#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# accel export: both forms, number for number, and what cannot be written. That POV-Ray hits the
# same triangles is tested by tests/povray/hits.sh.
# shellcheck source=tests/cli/common.sh
. "$(dirname "$0")/common.sh"

# lines FILE PATTERN COUNT
lines() {
    [ "$(grep -cE "$2" "$1")" = "$3" ] || fail "$1 has $(grep -cE "$2" "$1") lines '$2', not $3"
}

holds() {
    grep -qxF -e "$2" "$1" || fail "$1 does not hold the line '$2'"
}

# One triangle; 0.1 and 1e-30 are no floats, and are kept as double.
printf 'v 0.1 0 0\nv 1 0 0\nv 0 1e-30 -2\nf 1 2 3\n' >one.obj
expect 0 export one.obj -o triangles.inc --as triangles
[ ! -s out ] || fail "export prints something"
lines triangles.inc '^// 1 triangles in 1 geometries' 1
holds triangles.inc "#declare First = array[2] {0,1}"
holds triangles.inc "#declare Corners = array[1][3] {"
holds triangles.inc "{<0.10000000000000001,0,0>,<1,0,0>,<0,1.0000000000000001e-30,-2>}"
expect 0 export one.obj -o mesh.inc
lines mesh.inc '^// 1 triangles in 1 geometries' 1
holds mesh.inc "<0.100000001,0,0>,"
holds mesh.inc "<0,1e-30,-2>"
holds mesh.inc "<0,1,2>"

# The generators: all triangles, geometry by geometry, in order.
expect 0 export teapots:quads=2 -o teapots.inc --as triangles
total=$(grep -c '^{<' teapots.inc)
[ "$total" -ge 1000 ] || fail "teapots has $total triangles"
lines teapots.inc "^// $total triangles in 10 geometries" 1
lines teapots.inc "^#declare Corners = array\[$total\]\[3\] \{\$" 1
awk -F '[{,}]' -v total="$total" '/^#declare First/ {
        if ($2 != 0 || $12 != total || NF != 13) exit 1
        for (i = 3; i <= 12; i++) if ($i <= $(i - 1)) exit 1
        found = 1
    } END { exit !found }' teapots.inc || fail "First does not number the triangles of teapots"
expect 0 export teapots:quads=2 -o teapots-mesh.inc --as mesh2
lines teapots-mesh.inc '^#declare Geometry\[[0-9]\] = mesh2 \{$' 10
lines teapots-mesh.inc '^normal_vectors' 10
! grep -qiE 'nan|inf[^o]' teapots-mesh.inc || fail "the mesh has a coordinate that is no number"

# Of equal places one normal: the four corners of a flat square look up.
printf 'v 0 0 0\nv 1 0 0\nv 0 0 -1\nv 1 0 0\nv 1 0 -1\nv 0 0 -1\nf 1 2 3\nf 4 5 6\n' >square.obj
expect 0 export square.obj -o square.inc
lines square.inc '^<-?0.00000,1.00000,-?0.00000>,?$' 6

# Two geometries: every row in its place.
printf 'o a\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\no b\nv 2 0 0\nv 3 0 0\nv 2 1 0\nv 3 1 0\nf 4 5 6\nf 6 5 7\n' >two.obj
expect 0 export two.obj -o two.inc --as triangles
diff - <(tail -n +2 two.inc) <<'ROWS' || fail "the corners of two geometries are not as they should be"
#declare First = array[3] {0,1,3}
#declare Corners = array[3][3] {
{<0,0,0>,<1,0,0>,<0,1,0>},
{<2,0,0>,<3,0,0>,<2,1,0>},
{<2,1,0>,<3,0,0>,<3,1,0>}
}
ROWS

complains "geometry 0 is not of triangles" export spheres:n=5 -o x.inc
complains "unknown form 'mesh'" export one.obj -o x.inc --as mesh
complains "SCENE and -o FILE.inc are needed" export one.obj
complains "SCENE and -o FILE.inc are needed" export -o x.inc
complains "none.obj" export none.obj -o x.inc
complains "none/x.inc" export one.obj -o none/x.inc
complains "has no triangles" export empty -o x.inc
expect 2 export one.obj -o /dev/full
[ "$(wc -l <err)" = 1 ] || fail "a full disk is not told in one line"
# What float loses is told.
expect 0 export scale-1e-310 -o tiny.inc
grep -q 'triangles have no area once they are rounded to float' err || fail "tiny.inc: $(cat err)"
expect 0 export scale-1e-310 --as triangles -o tiny.inc
[ ! -s err ] || fail "tiny.inc as triangles: $(cat err)"

finish
