#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# OBJ files of every kind that readers are known to differ on.
# shellcheck source=tests/cli/mesh_common.sh
. "$(dirname "$0")/mesh_common.sh"

v='v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n'
unit='0 0 0, 1 1 0'

# Numbers.
loads leading_dot.obj 1 '0 0 0, 1 0.5 0' 'v 0 0 0\nv 1 0 0\nv .5 .5 0\nv 0 0 1\nv 1 0 1\nf 1 2 3\n'
loads trailing_dot.obj 1 '0 0 0, 1 1 0' 'v 0. 0. 0.\nv 1. 0 0\nv 0 1. 0\nf 1 2 3\n'
loads exponents.obj 1 '0 0 0, 1000 0.025 0' 'v 0e0 0E5 0\nv 1e3 0 0\nv 0 2.5E-2 0\nf 1 2 3\n'
loads exponent_sign.obj 1 '0 0 0, 100 1 0' 'v 0 0 0\nv 1e+2 0 0\nv 0 1e+00 0\nf 1 2 3\n'
loads signs.obj 1 '-1 0 0, 1 1 0' 'v -1 +0 -0\nv +1 0 0\nv 0 +1.0 0\nf 1 2 3\n'
loads round.obj 1 '0 0 0, 6.2572 1 0' 'v 0 0 0\nv 6.2572 0 0\nv 0 1 0\nf 1 2 3\n'
loads long_digits.obj 1 '0 0 0, 0.1 1 0' "v 0 0 0\nv 0.1$(printf '%0900d' 0) 0 0\nv 0 1 0\nf 1 2 3\n"
loads small.obj 1 '0 0 0, 1e-300 4.94065646e-324 0' 'v 0 0 0\nv 1e-300 0 0\nv 0 5e-324 0\nf 1 2 3\n'
loads underflow.obj 1 '0 0 0, 0 1 0' 'v 0 0 0\nv 1e-999 0 0\nv 0 1 0\nf 1 2 3\n'
refuses nan.obj ":2: found 'nan', allowed is a decimal number" 'v 0 0 0\nv nan 0 0\nv 0 1 0\nf 1 2 3\n'
refuses inf.obj ":2: found '-inf'" 'v 0 0 0\nv -inf 0 0\nv 0 1 0\nf 1 2 3\n'
refuses infinity.obj ":2: found 'Infinity'" 'v 0 0 0\nv Infinity 0 0\nv 0 1 0\nf 1 2 3\n'
refuses nan_indefinite.obj ":2: found '1.#QNAN'" 'v 0 0 0\nv 1.#QNAN 0 0\nv 0 1 0\nf 1 2 3\n'
refuses inf_indefinite.obj ":2: found '1.#INF'" 'v 0 0 0\nv 1 0 1.#INF\nv 0 1 0\nf 1 2 3\n'
refuses hex.obj ":2: found '0x10'" 'v 0 0 0\nv 0x10 0 0\nv 0 1 0\nf 1 2 3\n'
refuses overflow.obj ":2: found '1e999'" 'v 0 0 0\nv 1e999 0 0\nv 0 1 0\nf 1 2 3\n'
refuses comma.obj ":2: found '1,5'" 'v 0 0 0\nv 1,5 0 0\nv 0 1 0\nf 1 2 3\n'
refuses fortran.obj ":2: found '1.0D0'" 'v 0 0 0\nv 1.0D0 0 0\nv 0 1 0\nf 1 2 3\n'
refuses glued.obj ":2: found '1.0.0'" 'v 0 0 0\nv 1.0.0 0 0\nv 0 1 0\nf 1 2 3\n'
refuses half_exponent.obj ":2: found '1e'" 'v 0 0 0\nv 1e 0 0\nv 0 1 0\nf 1 2 3\n'
refuses dot.obj ":2: found '.'" 'v 0 0 0\nv . 0 0\nv 0 1 0\nf 1 2 3\n'
refuses sign.obj ":2: found '-'" 'v 0 0 0\nv - 1 0 0\nv 0 1 0\nf 1 2 3\n'

# Vertices with more or fewer numbers.
loads weight.obj 1 "$unit" 'v 0 0 0 1\nv 1 0 0 1.0\nv 0 1 0 0.5\nf 1 2 3\n'
loads colours.obj 1 "$unit" 'v 0 0 0 .1 .2 .3\nv 1 0 0 1 0 0\nv 0 1 0 255 255 255\nf 1 2 3\n'
loads colours_alpha.obj 1 "$unit" 'v 0 0 0 .1 .2 .3 1\nv 1 0 0 1 0 0 1\nv 0 1 0 0 0 0 0\nf 1 2 3\n'
loads colours_weight.obj 1 "$unit" 'v 0 0 0 1 .1 .2 .3 1\nv 1 0 0 1 1 0 0 1\nv 0 1 0 1 0 0 0 0\nf 1 2 3\n'
refuses two_numbers.obj ':2: a vertex of 2 numbers' 'v 0 0 0\nv 1 0\nv 0 1 0\nf 1 2 3\n'
refuses five_numbers.obj ':2: a vertex of 5 numbers' 'v 0 0 0\nv 1 0 0 1 1\nv 0 1 0\nf 1 2 3\n'
refuses nine_numbers.obj ':2: a vertex of more than 8' 'v 0 0 0\nv 1 0 0 1 1 1 1 1 1\nv 0 1 0\nf 1 2 3\n'
refuses no_number.obj ':2: a vertex of 0 numbers' 'v 0 0 0\nv\nv 0 1 0\nf 1 2 3\n'

# Lines, blanks and comments.
loads crlf.obj 2 '0 0 0, 1 1 1' "${v//\\n/\\r\\n}f 1 2 3\r\nf 1 2 4\r\n"
loads cr.obj 2 '0 0 0, 1 1 1' "${v//\\n/\\r}f 1 2 3\rf 1 2 4\r"
loads mixed_ends.obj 1 "$unit" 'v 0 0 0\r\nv 1 0 0\nv 0 1 0\rf 1 2 3'
loads no_last_end.obj 1 "$unit" "${v}f 1 2 3"
loads mark.obj 1 "$unit" "\xef\xbb\xbf${v}f 1 2 3\n"
loads tabs.obj 1 "$unit" 'v\t0\t0\t0\nv\t1\t0\t0\nv\t0 \t1\t0\t\nf\t1\t2\t3\t\n'
loads form_feeds.obj 1 "$unit" 'v 0 0 0\n\fv\f1 0 0\n\vv 0\v1 0\nf 1 2 3\n'
loads indented.obj 3 '0 0 0, 1 1 1' "${v}g part\n  f 1 2 3\n\tf 1 2 4\nf 2 3 4\n"
loads blank_lines.obj 1 "$unit" "\n\n  \n${v}\n\t\nf 1 2 3\n\n\n"
loads many_blanks.obj 1 "$unit" 'v    0   0  0   \nv 1  0  0\nv  0 1 0  \nf   1   2  3   \n'
loads comments.obj 1 "$unit" "# f 1 1 1\n#v 9 9 9\n${v}   # indented\nf 1 2 3 # f 4 4 4\n#"
loads comment_behind_vertex.obj 1 '0 0 0, 4 4 0' 'v 0 0 0\nv 4 0 0\nv 0 4 0 # corner 2 of 3\nv 0 0 4\nv 1 1 1\nf 1 2 3\n'
loads comment_glued.obj 1 "$unit" 'v 0 0 0#a\nv 1 0 0# b\nv 0 1 0\t#c\nf 1 2 3#d\n'
loads comment_numbers.obj 1 "$unit" 'v 0 0 0 # 1 2 3\nv 1 0 0 # 7\nv 0 1 0\nf 1 2 3 # 1\n'
loads comment_bytes.obj 1 "$unit" "# \x80\xff\xc3\xa9 \x01\n${v}f 1 2 3\n"
loads comment_only_backslash.obj 1 "$unit" "# from C:\\\\models\\\\\n${v}f 1 2 3\n"
loads comment_goes_on.obj 1 "$unit" "# this is long \\\\\n and ends here\n${v}f 1 2 3\n"
loads continued.obj 1 "$unit" "v 0 \\\\\n0 0\nv 1 0 0\nv 0 1 0\nf 1 \\\\\n 2 \\\\\n 3\n"
loads continued_crlf.obj 1 "$unit" "v 0 \\\\\r\n0 0\r\nv 1 0 0\r\nv 0 1 0\r\nf 1 2 \\\\\r\n3\r\n"
loads continued_blank.obj 1 "$unit" "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 \\\\  \n3\n"
loads continued_glued.obj 1 "$unit" "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2\\\\\n 3\n"
loads continued_end.obj 1 "$unit" "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3 \\\\"
loads continued_group.obj 1 "$unit" "${v}g a b \\\\\nc d\nf 1 2 3\n"
refuses continued_digits.obj ":4: found '2\\'" "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2\\\\\n3\n"
refuses backslash.obj ":4: found '\\'" "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 \\\\ 2 3\n"
loads long_line.obj 1 "$unit" "# $(printf '%070000d' 0)\n${v}f 1 2 3\n"
loads long_blanks.obj 1 "$unit" "v$(printf '%9000s' '') 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"
refuses nul.obj ":5: found 'f?1'" "${v}f\x001 2 3\n"
refuses nul_end.obj ":6: found '????'" "${v}f 1 2 3\n\x00\x00\x00\x00"
refuses gzip.obj 'is compressed by gzip' '\x1f\x8b\x08\x00v 0 0 0'
refuses utf16.obj 'is text in UTF-16' '\xff\xfev\x00 \x000\x00'

# Keywords.
loads upper_case.obj 1 "$unit" "${v//v/V}VN 0 0 1\nG part\nUSEMTL x\nF 1 2 3\n"
loads all_drawn.obj 1 "$unit" "mtllib a b.mtl\no name of object\n${v}vt 0 0\nvn 0 0 1\nvp 1 2\ng\ng a b\ns 1\ns off\nmg 1 0.5\nbevel on\nc_interp off\nd_interp off\nlod 3\nusemtl #1 \\\\ a\nmaplib x\nusemap off\nshadow_obj x.obj\ntrace_obj x.obj\nf 1/1/1 2/1/1 3/1/1\n"
loads usemtl_text.obj 1 "$unit" "${v}usemtl C:\\\\textures\\\\\nusemtl f 1 2 3\nusemtl\ng v 1 1 1\nf 1 2 3\n"
loads superseded.obj 1 "$unit" "${v}fo 1 2 3\n"
refuses unknown.obj ":5: found 'x', allowed is a statement of OBJ" "${v}x 1 2 3\nf 1 2 3\n"
refuses words.obj ":2: found '1.0', allowed is a statement" 'v 0 0 0\n1.0 0 0\nv 0 1 0\nf 1 2 3\n'
refuses no_blank.obj ":2: found 'v1'" 'v 0 0 0\nv1 0 0\nv 0 1 0\nf 1 2 3\n'
refuses call.obj ':1: found a call of another file' "call other.obj\n${v}f 1 2 3\n"
refuses csh.obj ':1: found a call of another file or program' "csh -rm x\n${v}f 1 2 3\n"

# Corners.
loads corner_forms.obj 4 '0 0 0, 1 1 1' "${v}vt 0 0\nvn 0 0 1\nf 1/1 2/1 3/1\nf 1//1 2//1 4//1\nf 1/1/1 3/1/1 4/1/1\nf 2/ 3// 4/1/\n"
loads corner_without_texture.obj 1 "$unit" "${v}f 1/7/9 2/8/9 3/9/9\n"
loads corner_sign.obj 1 "$unit" "${v}f +1 +2 +3\n"
loads relative.obj 2 '0 0 0, 1 1 1' "v 9 9 9\n${v}f -4 -3 -2\nf -1 -4 -3\n"
loads relative_forms.obj 1 "$unit" "${v}vt 0 0\nvn 0 0 1\nf -4/-1/-1 -3/-1/-1 -2/-1/-1\n"
loads relative_moves.obj 2 '0 0 0, 6 1 0' 'v 0 0 0\nv 1 0 0\nv 0 1 0\nf -3 -2 -1\nv 5 0 0\nv 6 0 0\nv 5 1 0\nf -3 -2 -1\n'
loads before_vertices.obj 1 "$unit" "f 1 2 3\n$v"
loads same_corner.obj 2 '0 0 0, 1 1 0' "${v}f 1 2 3\nf 1 1 2\n"
loads other_numbers.obj 1 "$unit" "vn 9 9 9\nvt 9 9\n${v}vn 1 2 3\nf 1 2 3\n"
refuses zero.obj ':5: a face refers to vertex 0 where there are 4' "${v}f 0 1 2\n"
refuses beyond.obj ':6: a face refers to vertex 5, but the file has 4' "${v}f 1 2 3\nf 1 2 5\nf 1 2 3\n"
refuses before_first.obj ':5: a face refers to vertex -5 where there are 4' "${v}f -5 1 2\n"
refuses huge.obj ':5: a face refers to vertex' "${v}f 1 2 99999999999999999999999\n"
refuses huge_negative.obj ':5: a face refers to vertex -' "${v}f 1 2 -99999999999999999999999\n"
refuses wraps.obj ':5: a face refers to vertex 4294967297' "${v}f 1 2 4294967297\n"
refuses fraction.obj ":5: found '2.5', allowed is a corner" "${v}f 1 2.5 3\n"
refuses float_corner.obj ":5: found '2.0'" "${v}f 1 2.0 3\n"
refuses letters.obj ":5: found '2a'" "${v}f 1 2a 3\n"
refuses apart.obj ":5: found '/'" "${v}f 1 / 1 2 3\n"
refuses three_slashes.obj ":5: found '1/1/1/1'" "${v}f 1/1/1/1 2 3\n"
refuses only_slash.obj ":5: found '/1'" "${v}f /1 2 3\n"
refuses short_face.obj ':5: a face of 2 corners' "${v}f 1 2"
refuses empty_face.obj ':5: a face of 0 corners' "${v}f\n"

# What is no triangle.
loads left_out.obj 1 "$unit" "${v}l 1 2\nl 1 2 3\np 1 2\nl 1/1 2/2\nf 1 2 3\nf 1 2\ncurv 0 1 1 2 3\n" '8 points and lines are left out'
refuses lines.obj 'holds no triangle; 1 points and lines are there' "${v}l 1 2\n"
refuses vertices.obj 'holds no triangle' "$v"
refuses surface.obj ':6: found a free-form surface' "${v}deg 1 1\nsurf 0 1 0 1 1 2 3 4\nend\nf 1 2 3\n"
loads curve_words.obj 1 "$unit" "${v}cstype bezier\ndeg 3\nctech cparm 1\nparm u 0 1\nend\nf 1 2 3\n"

# Polygons.
loads quad.obj 2 '0 0 0, 1 1 0' 'v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n'
loads concave.obj 2 '0 0 0, 4 4 0' 'v 0 0 0\nv 4 0 0\nv 1 1 0\nv 0 4 0\nf 1 2 3 4\n'
loads pentagon.obj 3 '0 0 0, 2 2 0' 'v 0 0 0\nv 2 0 0\nv 2 1 0\nv 1 2 0\nv 0 1 0\nf 1 2 3 4 5\n'
loads late_polygon.obj 2 '0 0 0, 4 4 0' 'f 1 2 3 4\nv 0 0 0\nv 4 0 0\nv 1 1 0\nv 0 4 0\n'
loads flat_polygon.obj 3 '0 0 0, 4 0 0' 'v 0 0 0\nv 1 0 0\nv 2 0 0\nv 3 0 0\nv 4 0 0\nf 1 2 3 4 5\n'
loads crossing.obj 2 '0 0 0, 1 1 0' 'v 0 0 0\nv 1 1 0\nv 1 0 0\nv 0 1 0\nf 1 2 3 4\n' '1 faces cross themselves'
loads pentagram.obj 3 '-1 -1 0, 1 1 0' 'v 0 1 0\nv 0.6 -1 0\nv -1 0.2 0\nv 1 0.2 0\nv -0.6 -1 0\nf 1 2 3 4 5\n' '1 faces cross themselves'
gon=$(for ((i = 0; i < 1000; i++)); do printf 'v %d %d 0\\n' $((i < 500 ? i : 999 - i)) $((i < 500 ? 0 : 1)); done)
loads many_corners.obj 998 '0 0 0, 499 1 0' "${gon}f $(seq -s ' ' 1000)\n"
spiral=$(awk 'BEGIN { for (i = 0; i < 600; i++) printf "v %.9g %.9g 0\\n", i * cos(i / 20), i * sin(i / 20)
    for (i = 599; i >= 0; i--) printf "v %.9g %.9g 0\\n", (i + 9) * cos(i / 20), (i + 9) * sin(i / 20) }')
write spiral.obj "${spiral}f $(seq -s ' ' 1200)\n"
expect 0 info spiral.obj -a linear
says "spiral.obj: 1198 primitives"
[ ! -s err ] || fail "a spiral is taken for a polygon that crosses itself: $(cat err)"

# A concave polygon is cut inside: a ray beside it meets nothing, one through it the triangles.
printf '3 3 5 0 0 -1\n0.2 3 5 0 0 -1\n3 0.2 5 0 0 -1\n1.2 1.2 5 0 0 -1\n0.5 0.5 5 0 0 -1\n' >rays.txt
expect 0 trace concave.obj --rays rays.txt -o hits.txt
[ "$(cut -d' ' -f1 hits.txt | tr '\n' ' ')" = "miss 0 0 miss 0 " ] || fail "concave.obj: $(cat hits.txt)"
expect 0 trace late_polygon.obj --rays rays.txt -o late.txt
cmp hits.txt late.txt || fail "a polygon before its vertices is cut otherwise"

# Objects and groups are geometries.
loads parts.obj 3 '0 0 0, 6 1 0' "o a\n${v}f 1 2 3\no b\nv 5 0 0\nv 6 0 0\nv 5 1 0\ng none\ng c\nf 5 6 7\nf 1 2 3\n"
says 'parts.obj: 3 primitives in 2 geometries'
printf '5.2 0.2 5 0 0 -1\n0.2 0.2 5 0 0 -1\n' >rays.txt
expect 0 trace parts.obj --rays rays.txt -o hits.txt
[ "$(cut -d' ' -f1-3 hits.txt | tr '\n' ' ')" = "1 0 5 0 0 5 " ] || fail "parts.obj: $(cat hits.txt)"

# The name does not matter, but where the content leaves it open.
write content.ply "${v}f 1 2 3\n"
check_loads content.ply 1 "$unit" ''
write numbers.txt 'v 1e-300 0 0\nv 1 0 0\nv 0 1.0000000000000000000001 0\nf 1 2 3\n'
check_loads numbers.txt 1 "$unit" ''
write content.txt "mtllib a.mtl\n${v}f 1 2 3\n"
check_loads content.txt 1 "$unit" ''
finish_cases
