#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# PLY files of every kind that readers are known to differ on.
# shellcheck source=tests/cli/mesh_common.sh
. "$(dirname "$0")/mesh_common.sh"

unit='0 0 0, 1 1 1'
corners='0 0 0\n1 0 0\n0 1 0\n0 0 1\n'
four='3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 3 2\n'
xyz='property float x\nproperty float y\nproperty float z\n'
list='property list uchar int vertex_indices\n'
text="ply\nformat ascii 1.0\nelement vertex 4\n${xyz}element face 4\n${list}end_header\n"

# Headers.
loads plain.ply 4 "$unit" "$text$corners$four"
loads trailing_blanks.ply 4 "$unit" "ply\nformat ascii 1.0\nelement vertex 4      \n${xyz}element face 4\n${list}end_header \n$corners$four"
loads tabs.ply 4 "$unit" "ply\nformat\tascii\t1.0\nelement\tvertex\t4\t\n${xyz//property /property\\t}element face 4\n${list}end_header\t\n${corners// /\\t}$four"
loads many_blanks.ply 4 "$unit" "ply  \n format  ascii   1.0\n  element  vertex  4\n${xyz}\n\nelement face 4\n${list}end_header\n$corners$four"
loads crlf.ply 4 "$unit" "$(sed 's/\\n/\\r\\n/g' <<<"$text$corners$four")"
loads cr.ply 4 "$unit" "$(sed 's/\\n/\\r/g' <<<"$text$corners$four")"
loads mark.ply 4 "$unit" "\xef\xbb\xbf$text$corners$four"
loads upper_case.ply 4 "$unit" "PLY\nFORMAT ASCII 1.0\nELEMENT VERTEX 4\nPROPERTY FLOAT X\nPROPERTY FLOAT Y\nPROPERTY FLOAT Z\nELEMENT FACE 4\n${list}END_HEADER\n$corners$four"
loads comments.ply 4 "$unit" "ply\ncomment before the format\nformat ascii 1.0\ncomment\ncomment element face 9\nobj_info num_cols 512\nelement vertex 4\ncomment here\n${xyz}comment there\nelement face 4\n${list}comment property list\nend_header\n$corners$four"
loads format_late.ply 4 "$unit" "ply\nelement vertex 4\n${xyz}element face 4\n${list}format ascii 1.0\nend_header\n$corners$four"
loads vertex_index.ply 4 "$unit" "${text/indices/index}$corners$four"
refuses no_magic.ply ":1: found 'plx'" "plx\nformat ascii 1.0\nend_header\n"
refuses no_format.ply 'its PLY header has no format' "ply\nelement vertex 4\n${xyz}element face 4\n${list}end_header\n$corners$four"
refuses other_format.ply ":2: found 'binary', allowed is one of ascii" "${text/ascii/binary}$corners$four"
refuses other_version.ply ":2: found 'ascii'" "${text/1.0/2.0}$corners$four"
refuses two_formats.ply ':3: a second format' "${text/1.0\\n/1.0\\nformat ascii 1.0\\n}$corners$four"
refuses no_end.ply 'the file ends within its header' "ply\nformat ascii 1.0\nelement vertex 4\n$xyz"
refuses unknown_line.ply ":3: found 'elements', allowed is format, element" "${text/element/elements}$corners$four"
refuses unknown_type.ply ":4: found 'toast', allowed is a type" "${text/float/toast}$corners$four"
refuses no_name.ply ':4: found the end of the line' "${text/property float x/property float}$corners$four"
refuses more_words.ply ":4: found 'w', allowed is the end of the line" "${text/float x/float x w}$corners$four"
refuses float_count.ply ":8: found 'float', allowed is the whole type" "${text/list uchar/list float}$corners$four"
refuses count_sign.ply ":3: found '-4'" "${text/vertex 4/vertex -4}$corners$four"
refuses count_fraction.ply ":3: found '4.0'" "${text/vertex 4/vertex 4.0}$corners$four"
refuses early_property.ply ':3: a property before' "ply\nformat ascii 1.0\n${xyz}end_header\n"
refuses no_z.ply ':3: vertices without a property x, y or z' "${text/float z/float w}$corners$four"
refuses two_x.ply ':7: a second property' "${text/property float z\\n/property float z\\nproperty float x\\n}$corners$four"
refuses two_vertices.ply ':9: a second element' "${text/end_header/element vertex 1\\nend_header}$corners$four"
refuses no_vertices.ply 'promises no element vertex' "ply\nformat ascii 1.0\nelement face 4\n${list}end_header\n$four"
refuses no_list.ply ':7: faces without a list' "${text/vertex_indices/corner_numbers}$corners$four"
refuses unknown_faces.ply ':7: an unknown element of vertices' "${text/face/trifans}$corners$four"
refuses control.ply ":3: found 'e?[2Jment'" "ply\nformat ascii 1.0\ne\x1b[2Jment vertex 4\nend_header\n"

# Elements and properties.
loads faces_first.ply 4 "$unit" "ply\nformat ascii 1.0\nelement face 4\n${list}element vertex 4\n${xyz}end_header\n$four$corners"
loads faces_first_polygon.ply 2 '0 0 0, 4 4 0' "ply\nformat ascii 1.0\nelement face 1\n${list}element vertex 4\n${xyz}end_header\n4 0 1 2 3\n0 0 0\n4 0 0\n1 1 0\n0 4 0\n"
loads unknown_elements.ply 4 "$unit" "ply\nformat ascii 1.0\nelement camera 1\nproperty float f\nproperty list uchar float p\nelement vertex 4\n${xyz}element material 2\nproperty uchar r\nelement face 4\n${list}element empty 3\nelement none 0\nproperty int i\nend_header\n1 2 3 4\n${corners}1\nnan\n$four"
loads no_properties.ply 4 "$unit" "ply\nformat ascii 1.0\nelement empty 4000000000\nelement vertex 4\n${xyz}element face 4\n${list}end_header\n$corners$four"
loads more_properties.ply 4 "$unit" "ply\nformat ascii 1.0\nelement vertex 4\nproperty uchar red\n${xyz}property list uchar float n\nproperty double w\nelement face 4\nproperty uchar a\n${list}property list uchar float texcoord\nend_header\n9 0 0 0 0 nan\n9 1 0 0 2 7 7 1\n9 0 1 0 1 inf 1\n9 0 0 1 0 1\n9 3 0 2 1 6 1 2 3 4 5 6\n9 3 0 1 3 0\n9 3 1 2 3 0\n9 3 0 3 2 0\n"
loads many_properties.ply 4 "$unit" "ply\nformat ascii 1.0\nelement vertex 4\n${xyz}$(for i in {1..90}; do printf 'property float f%d\\n' "$i"; done)element face 4\n${list}end_header\n$(for c in '0 0 0' '1 0 0' '0 1 0' '0 0 1'; do printf '%s%s\\n' "$c" "$(printf ' 7%.0s' {1..90})"; done)$four"
loads types.ply 4 "$unit" "ply\nformat ascii 1.0\nelement vertex 4\nproperty double x\nproperty int8 y\nproperty uint64 z\nelement face 4\nproperty list int64 uint64 vertex_indices\nend_header\n$corners$four"
loads edges.ply 4 "$unit" "${text/end_header/element edge 2\\nproperty int vertex1\\nproperty int vertex2\\nend_header}$corners${four}0 1\n1 2\n" '2 points and lines are left out'
loads strips.ply 6 "$unit" "ply\nformat ascii 1.0\nelement vertex 4\n${xyz}element tristrips 1\nproperty list int int vertex_indices\nend_header\n${corners}11 0 1 2 3 -1 0 3 1 2 0 3\n"
loads strip_restarts.ply 2 "$unit" "ply\nformat ascii 1.0\nelement vertex 4\n${xyz}element tristrips 2\nproperty list int int vertex_index\nend_header\n${corners}10 -1 0 1 -1 0 1 2 -1 -1 3\n3 0 1 3\n"
loads faces_and_strips.ply 5 "$unit" "ply\nformat ascii 1.0\nelement vertex 4\n${xyz}element face 4\n${list}element tristrips 1\nproperty list int int vertex_indices\nend_header\n$corners${four}3 0 1 2\n"
loads quads.ply 2 '0 0 0, 4 4 0' "${text/face 4/face 1}0 0 0\n4 0 0\n1 1 0\n0 4 0\n4 0 1 2 3\n"
gon=$(for ((i = 0; i < 600; i++)); do printf '%d %d 0\\n' $((i < 300 ? i : 599 - i)) $((i < 300 ? 0 : 1)); done)
loads many_corners.ply 598 '0 0 0, 299 1 0' "$(sed 's/vertex 4/vertex 600/; s/face 4/face 1/; s/uchar int/int int/' <<<"$text")${gon}600 $(seq -s ' ' 0 599)\n"
loads short_faces.ply 1 '0 0 0, 1 1 0' "$text${corners}3 0 1 2\n2 0 1\n1 3\n0\n" '3 points and lines are left out'
refuses points.ply 'holds no triangle' "ply\nformat ascii 1.0\nelement vertex 4\n${xyz}end_header\n$corners"
refuses no_faces.ply 'holds no triangle' "${text/face 4/face 0}$corners"

# Text behind the header.
loads wrapped.ply 4 "$unit" "${text}0 0\n0\n1 0 0\n0 1 0\n0 0 1\n3 0\n2\n1\n${four#*\\n}"
loads blank_lines.ply 4 "$unit" "$text\n\n0 0 0\n1 0 0\n \n0 1 0\n0 0 1\n\n$four\n\n"
loads no_last_end.ply 4 "$unit" "$text$corners${four%\\n}"
loads indented.ply 4 "$unit" "$text  ${corners//\\n/  \\n\\t}$four"
loads numbers.ply 4 '0 0 0, 1000 0.5 1' "${text}0 0 -0\n1e3 0. 0\n+0 .5 0\n0 0 1.0\n$four"
loads whole_as_float.ply 4 "$unit" "$text${corners}3.0 0.0 2.0 1.0\n${four#*\\n}"
loads rest.ply 4 "$unit" "$text$corners${four}3 0 1 2\n" 'its last 8 bytes, behind the mesh, are not read'
refuses nan.ply ":11: found 'nan'" "${text}0 0 0\nnan 0 0\n0 1 0\n0 0 1\n$four"
refuses hex.ply ":11: found '0x1'" "${text}0 0 0\n0x1 0 0\n0 1 0\n0 0 1\n$four"
refuses comma.ply ":11: found '0,5'" "${text}0 0 0\n0,5 0 0\n0 1 0\n0 0 1\n$four"
refuses more_numbers.ply ":11: found '7', allowed is the end of the line" "${text}0 0 0\n1 0 0 7\n0 1 0\n0 0 1\n$four"
refuses fewer_numbers.ply ":12: found '1', allowed is the end of the line" "${text}0 0 0\n1 0\n0 1 0\n0 0 1\n$four"
refuses fewer_corners.ply ":14: found '1', allowed is the end of the line" "$text${corners}2 0 2 1\n${four#*\\n}"
refuses body_comment.ply ":11: found 'comment'" "${text}0 0 0\ncomment\n1 0 0\n0 1 0\n0 0 1\n$four"
refuses beyond.ply ':16: a face refers to vertex 4, but the file has 4' "$text${corners}3 0 2 1\n3 0 1 3\n3 1 2 4\n3 0 3 2\n"
refuses negative.ply ':16: found -1, allowed is the number of a vertex' "$text${corners}3 0 2 1\n3 0 1 3\n3 1 2 -1\n3 0 3 2\n"
refuses fraction.ply ':14: found 1.5, allowed is the number of a vertex' "$text${corners}3 0 1.5 1\n${four#*\\n}"
refuses huge_index.ply ':14: found 1e+20' "$text${corners}3 0 100000000000000000000 1\n${four#*\\n}"
refuses negative_count.ply ':14: found -3' "$text${corners}-3 0 2 1\n${four#*\\n}"
refuses hostile_list.ply ':14: found 4000000000' "$text${corners}4000000000 0 2 1\n${four#*\\n}"
refuses strip_beyond.ply ':14: a face refers to vertex 4' "ply\nformat ascii 1.0\nelement vertex 4\n${xyz}element tristrips 1\nproperty list int int vertex_indices\nend_header\n${corners}5 0 1 2 3 4\n"
refuses strip_negative.ply ':14: found -2' "ply\nformat ascii 1.0\nelement vertex 4\n${xyz}element tristrips 1\nproperty list int int vertex_indices\nend_header\n${corners}5 0 1 2 3 -2\n"
refuses cut.ply ':17: found the end of the file' "$text${corners}${four%3 0 3*}"
for count in 400 2147483647 4294967295 99999999999999999; do
    refuses "vertices_$count.ply" "promises $count of element 'vertex'" "${text/vertex 4/vertex $count}$corners$four"
    refuses "faces_$count.ply" "promises $count of element 'face'" "${text/face 4/face $count}$corners$four"
done
refuses more_digits.ply ":3: found '18446744073709551616'" "${text/vertex 4/vertex 18446744073709551616}$corners$four"

# A float in text is the nearest float, rounded once: the second lies a little above the middle of two,
# where the nearest double is. What no float is near stays a double.
write floats.ply "ply\nformat ascii 1.0\nelement vertex 3\n${xyz}element face 1\n${list}end_header\n0.1 1.00000005960464477539062500001 0\n1e300 0 0\n0 0 1\n3 0 1 2\n"
expect 0 export floats.ply -o floats.inc --as triangles
grep -qxF '{<0.10000000149011612,1.0000001192092896,0>,<1.0000000000000001e+300,0,0>,<0,0,1>}' floats.inc ||
    fail "floats.ply: $(tail -n 2 floats.inc)"

# Binary.
le=$(little 0 0 0 1 0 0 0 1 0 0 0 1) be=$(big 0 0 0 1 0 0 0 1 0 0 0 1)
le_faces= be_faces=
for face in '0 2 1' '0 1 3' '1 2 3' '0 3 2'; do
    read -r a b c <<<"$face"
    le_faces+="\x03$(little "i$a" "i$b" "i$c")" be_faces+="\x03$(big "i$a" "i$b" "i$c")"
done
little=${text/ascii/binary_little_endian} big=${text/ascii/binary_big_endian}
loads little.ply 4 "$unit" "$little$le$le_faces"
loads big.ply 4 "$unit" "$big$be$be_faces"
loads little_trailing_blank.ply 4 "$unit" "${little/end_header/end_header  }$le$le_faces"
loads little_crlf.ply 4 "$unit" "$(sed 's/\\n/\\r\\n/g' <<<"$little")$le$le_faces"
loads little_cr.ply 4 "$unit" "$(sed 's/\\n/\\r/g' <<<"$little")$le$le_faces"
first_0a="\x0a\x00\x80\x3f$(little .5 .25 2 .5 .25 .5 1.5 .25 .5 .5 1.25)"
loads first_0a.ply 4 '0.5 0.5 0.25, 2 1.5 1.25' "$little$first_0a$le_faces"
loads first_0a_crlf.ply 4 '0.5 0.5 0.25, 2 1.5 1.25' "$(sed 's/\\n/\\r\\n/g' <<<"$little")$first_0a$le_faces"
loads first_0a_cr.ply 4 '0.5 0.5 0.25, 2 1.5 1.25' "$(sed 's/\\n/\\r/g' <<<"$little")$first_0a$le_faces"
loads first_0d.ply 4 '0.5 0.5 0.25, 2 1.5 1.25' "$little\x0d${first_0a#\\x0a}$le_faces"
loads first_blank.ply 4 '0.5 0.5 0.25, 2 1.5 1.25' "$little\x20${first_0a#\\x0a}$le_faces"
loads doubles.ply 1 '0 0 0, 0.1 1 0' "ply\nformat binary_little_endian 1.0\nelement vertex 3\nproperty double x\nproperty uchar y\nproperty short z\nelement face 1\nproperty list ushort uchar vertex_index\nend_header\n$(printf '\\x00%.0s' {1..11})\x9a\x99\x99\x99\x99\x99\xb9\x3f\x00\x00\x00$(printf '\\x00%.0s' {1..8})\x01\x00\x00\x03\x00\x00\x01\x02"
loads long_lists.ply 1 '0 0 0, 1 1 0' "ply\nformat binary_big_endian 1.0\nelement vertex 3\n${xyz}element face 1\nproperty list uint64 int64 vertex_index\nend_header\n$(big 0 0 0 1 0 0 0 1 0 i0 i3 i0 i0 i0 i1 i0 i2)"
loads binary_elements.ply 4 "$unit" "${little/element face/element skip 2\\nproperty double d\\nproperty list uchar short s\\nelement plain 3\\nproperty int i\\nelement nothing 4000000000\\nelement face}$le$(little i0 i0)\x00$(little i0 i0)\x02\x01\x01\x01\x01$(little i1 i2 i3)$le_faces"
loads binary_faces_first.ply 4 "$unit" "ply\nformat binary_little_endian 1.0\nelement face 4\n${list}element vertex 4\n${xyz}end_header\n$le_faces$le"
loads binary_strips.ply 6 "$unit" "ply\nformat binary_little_endian 1.0\nelement vertex 4\n${xyz}element tristrips 1\nproperty list int int vertex_indices\nend_header\n$le$(little i11 i0 i1 i2 i3 i-1 i0 i3 i1 i2 i0 i3)"
loads binary_rest.ply 4 "$unit" "$little$le$le_faces\x07\x08" 'its last 2 bytes, behind the mesh, are not read'
refuses binary_cut.ply 'found 3, allowed is a list' "$little$le${le_faces%\\x00}"
refuses binary_cut_count.ply 'the file ends before all that its PLY header promises' "$little$le${le_faces:0:156}"
refuses binary_beyond.ply ", byte $(($(printf '%b' "$little$le" | wc -c) + 1)): a face refers to vertex 9, but the file has 4" "$little$le\x03$(little i0 i9 i1)${le_faces:52}"
refuses binary_negative.ply 'found -1, allowed is the number of a vertex' "$little$le\x03$(little i0 i-1 i1)${le_faces:52}"
refuses binary_hostile_list.ply 'found 255, allowed is a list' "$little$le\xff$(little i0 i1 i2)${le_faces:52}"
refuses binary_signed_list.ply 'found -1, allowed is a list' "${little/uchar/char}$le\xff$(little i0 i1 i2)${le_faces:52}"
for count in 19 2147483647 4294967295 99999999999999999; do
    refuses "binary_vertices_$count.ply" "promises" "${little/vertex 4/vertex $count}$le$le_faces"
    refuses "binary_faces_$count.ply" "promises" "${little/face 4/face $count}$le$le_faces"
done

# A NaN of a binary file is loaded; its triangles are skipped and counted.
write binary_nan.ply "$little${le/\\x00\\x00\\x80\\x3f/\\x00\\x00\\xc0\\x7f}$le_faces"
expect 0 info binary_nan.ply -a linear
says "3 invalid primitives, first (geometry/primitive) 0/0 0/1 0/2"

# The name does not matter.
write little.obj "$little$le$le_faces"
check_loads little.obj 4 "$unit" ''
finish_cases
