#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# OFF files of every kind that readers are known to differ on.
# shellcheck source=tests/cli/mesh_common.sh
. "$(dirname "$0")/mesh_common.sh"

unit='0 0 0, 1 1 1'
corners='0 0 0\n1 0 0\n0 1 0\n0 0 1\n'
four='3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 3 2\n'

# Headers.
loads plain.off 4 "$unit" "OFF\n4 4 6\n$corners$four"
loads same_line.off 4 "$unit" "OFF 4 4 6\n$corners$four"
loads glued.off 4 "$unit" "OFF4 4 6\n$corners$four"
loads no_keyword.off 4 "$unit" "4 4 6\n$corners$four"
loads no_edges.off 4 "$unit" "OFF\n4 4\n$corners$four"
loads apart.off 4 "$unit" "OFF\n\n4\n4\n6\n$corners$four"
loads lower_case.off 4 "$unit" "off\n4 4 6\n$corners$four"
loads comments.off 4 "$unit" "# before\nOFF # the word\n# 9 9 9\n\n4 4 6 # counts\n#\n${corners/1 0 0/1 0 0 # second}\n  # faces\n${four/3 0 1 3/3 0 1 3 # red}\n# end\n"
loads comment_glued.off 4 "$unit" "OFF#a\n4 4 6#b\n${corners/1 0 0/1 0 0#c}${four/3 0 1 3/3 0 1 3#d}"
loads crlf.off 4 "$unit" "$(sed 's/\\n/\\r\\n/g' <<<"OFF\n4 4 6\n$corners$four")"
loads cr.off 4 "$unit" "$(sed 's/\\n/\\r/g' <<<"OFF\n4 4 6\n$corners$four")"
loads tabs.off 4 "$unit" "$(sed 's/ /\\t/g; s/\\n/ \\n\\t/g' <<<"OFF\n4 4 6\n$corners$four")"
loads mark.off 4 "$unit" "\xef\xbb\xbfOFF\n4 4 6\n$corners$four"
loads no_last_end.off 4 "$unit" "OFF\n4 4 6\n$corners${four%\\n}"
refuses other_word.off ":1: found 'OOF'" "OOF\n4 4 6\n$corners$four"
refuses no_counts.off 'found the end of the file, allowed is the numbers of vertices' 'OFF\n'
refuses count_sign.off ":2: found '-4'" "OFF\n-4 4 6\n$corners$four"
refuses count_fraction.off ":2: found '4.5'" "OFF\n4 4.5 6\n$corners$four"
refuses four_counts.off ":2: found '1', allowed is the end of the line" "OFF\n4 4 6 1\n$corners$four"

# Colours, normals and texture coordinates.
coloured='0 0 0 255 0 0 255\n1 0 0 0 255 0 255\n0 1 0 .1 .2 .3 1\n0 0 1 1 1 1 1\n'
normals='0 0 0 0 0 1\n1 0 0 0 0 1\n0 1 0 0 0 1\n0 0 1 0 0 1\n'
loads coff.off 4 "$unit" "COFF\n4 4 6\n$coloured$four"
loads noff.off 4 "$unit" "NOFF\n4 4 6\n$normals$four"
loads stoff.off 4 "$unit" "STOFF\n4 4 6\n0 0 0 .5 .5\n1 0 0 .5 .5\n0 1 0 .5 .5\n0 0 1 .5 .5\n$four"
loads cnoff.off 4 "$unit" "STCNOFF\n4 4 6\n${coloured//\\n/ 0 0 1 .5 .5\\n}$four"
loads colours_without_c.off 4 "$unit" "OFF\n4 4 6\n$coloured$four"
loads face_colours.off 4 "$unit" "OFF\n4 4 6\n${corners}3 0 2 1 255 0 0\n3 0 1 3 0.5 0.5 0.5 1\n3 1 2 3 7\n3 0 3 2\n"
refuses uneven.off ':4: a vertex with 1 numbers behind its coordinates, where the first one has 0' "OFF\n4 4 6\n0 0 0\n1 0 0 1\n0 1 0\n0 0 1\n$four"
refuses two_on_a_line.off ':5: a vertex with' "OFF\n4 4 6\n0 0 0 1 0 0\n0 1 0 0 0 1\n$four"
refuses two_numbers.off ':5: a vertex with 0 numbers behind its coordinates, where the first one has 2' "OFF\n4 4 6\n0 0\n1 0 0\n0 1 0\n0 0 1\n$four"
refuses five_colours.off ':7: a face with 5 numbers behind its corners' "OFF\n4 4 6\n${corners}3 0 2 1 1 2 3 4 5\n${four#*\\n}"
refuses words_behind.off ":7: found 'red'" "OFF\n4 4 6\n${corners}3 0 2 1 red\n${four#*\\n}"

# Dimensions.
loads four_off.off 4 "$unit" "4OFF\n4 4 6\n0 0 0 1\n2 0 0 2\n0 1 0 1\n0 0 .25 .25\n$four"
loads n_off.off 4 "$unit" "nOFF\n3\n4 4 6\n$corners$four"
loads n_off_line.off 4 "$unit" "nOFF 3\n4 4 6\n$corners$four"
refuses unclear.off ':1: found noff, allowed are NOFF' "noff\n3\n4 4 6\n$corners$four"
refuses unclear_too.off ':1: found noff, allowed are NOFF' "stcnoff\n3\n4 4 6\n$corners$four"
refuses infinity.off 'vertex 1, counted from 0, is at infinity' "4OFF\n4 4 6\n0 0 0 1\n2 0 0 0\n0 1 0 1\n0 0 1 1\n$four"
refuses n_off_5.off ':2: vertices of 5 dimensions, allowed are 3' "nOFF\n5\n4 4 6\n$corners$four"
refuses n4_off.off ':2: vertices of 3 dimensions and a divisor' "4nOFF\n3\n4 4 6\n$corners$four"

# Vertices and faces.
loads wrapped.off 4 "$unit" "OFF\n4 4 6\n0\n0 0\n1 0 0\n0 1 0\n0 0 1\n3 0\n2\n1\n${four#*\\n}"
loads polygon.off 8 '-1 -0.951057 0, 1 0.951057 0' 'OFF\n10 1 0\n1.000000 0.000000 0\n0.809017 0.587785 0\n0.309017 0.951057 0\n-0.309017 0.951057 0\n-0.809017 0.587785 0\n-1.000000 0.000000 0\n-0.809017 -0.587785 0\n-0.309017 -0.951057 0\n0.309017 -0.951057 0\n0.809017 -0.587785 0\n10 0 1 2 3 4 5 6 7 8 9\n'
loads concave.off 2 '0 0 0, 4 4 0' 'OFF\n4 1 0\n0 0 0\n4 0 0\n1 1 0\n0 4 0\n4 0 1 2 3\n'
loads short_faces.off 1 '0 0 0, 1 1 0' "OFF\n4 4 0\n${corners}2 0 1\n1 0\n0\n3 0 1 2\n" '3 points and lines are left out'
loads round.off 1 '0 0 0, 6.2572 1 0' 'OFF\n3 1 0\n0 0 0\n6.2572 0 0\n0 1 0\n3 0 1 2\n'
loads rest.off 4 "$unit" "OFF\n4 4 6\n$corners${four}3 0 1 2\n" 'its last 8 bytes, behind the mesh, are not read'
refuses nan.off ":4: found 'nan'" "OFF\n4 4 6\n0 0 0\nnan 0 0\n0 1 0\n0 0 1\n$four"
refuses nan_indefinite.off ":4: found '1.#IND'" "OFF\n4 4 6\n0 0 0\n1.#IND 0 0\n0 1 0\n0 0 1\n$four"
refuses beyond.off ':9: a face refers to vertex 4, but the file has 4' "OFF\n4 4 6\n${corners}3 0 2 1\n3 0 1 3\n3 1 2 4\n3 0 3 2\n"
refuses negative.off ':7: a face refers to vertex -1' "OFF\n4 4 6\n${corners}3 0 -1 1\n${four#*\\n}"
refuses fraction.off ":7: found '2.5'" "OFF\n4 4 6\n${corners}3 0 2.5 1\n${four#*\\n}"
refuses too_few_corners.off 'found the end of the file' "OFF\n4 4 6\n${corners}9 0 1 2\n${four#*\\n}"
refuses cut_vertices.off 'promises 4 vertices and 4 faces' 'OFF\n4 4 6\n0 0 0\n1 0 0\n0 1'
refuses cut_later.off ':5: found the end of the file' 'OFF\n4 4 6\n0.000 0.000 0.000\n1.000 0.000 0\n0.00 1'
refuses cut_faces.off 'found the end of the file' "OFF\n4 4 6\n${corners}3 0 2 1\n3 0 1"
refuses no_faces.off 'holds no triangle' "OFF\n4 0 0\n$corners"
refuses nul.off ":4: found '1?'" "OFF\n4 4 6\n0 0 0\n1\x00 0 0\n0 1 0\n0 0 1\n$four"
for count in 40 2147483647 4294967295 99999999999999999; do
    refuses "vertices_$count.off" "promises $count vertices and 4 faces" "OFF\n$count 4 6\n$corners$four"
    refuses "faces_$count.off" "promises 4 vertices and $count faces" "OFF\n4 $count 6\n$corners$four"
done

# Binary, all big-endian.
vertices=$(big 0 0 0 1 0 0 0 1 0 0 0 1)
faces=$(big i3 i0 i2 i1 i0 i3 i0 i1 i3 i1 i7 i3 i1 i2 i3 i4 i0 i0 i0 i0 i3 i0 i3 i2 i0)
counts=$(big i4 i4 i6)
loads binary.off 4 "$unit" "OFF BINARY\n$counts$vertices$faces"
loads binary_normals.off 1 '0 0 0, 1 1 0' "NOFF BINARY\n$(big i3 i1 i3 0 0 0 9 9 9 1 0 0 9 9 9 0 1 0 9 9 9 i3 i0 i1 i2 i0)"
loads binary_colours.off 1 '0 0 0, 1 1 0' "COFF BINARY\n$(big i3 i1 i3 0 0 0 9 9 9 9 1 0 0 9 9 9 9 0 1 0 9 9 9 9 i3 i0 i1 i2 i0)"
loads binary_four.off 1 '0 0 0, 1 1 0' "4OFF BINARY\n$(big i3 i1 i3 0 0 0 1 2 0 0 2 0 1 0 1 i3 i0 i1 i2 i0)"
loads binary_quad.off 2 '0 0 0, 4 4 0' "OFF BINARY\n$(big i4 i1 i0 0 0 0 4 0 0 1 1 0 0 4 0 i4 i0 i1 i2 i3 i0)"
loads binary_rest.off 4 "$unit" "OFF BINARY\n$counts$vertices$faces\x01" 'its last 1 bytes'
refuses binary_cut.off 'the file ends before all that its OFF header promises' "OFF BINARY\n$counts$vertices${faces%\\x00}"
refuses binary_beyond.off 'a face refers to vertex 4, but the file has 4' "OFF BINARY\n$counts$vertices${faces/x03\\x00\\x00\\x00\\x04/x04\\x00\\x00\\x00\\x04}"
refuses binary_little.off 'promises' "OFF BINARY\n$(little i4 i4 i6)$vertices$faces"
refuses binary_hostile.off 'promises 4 vertices and 2147483647 faces' "OFF BINARY\n$(big i4 i2147483647 i6)$vertices$faces"
refuses binary_negative.off 'found -1' "OFF BINARY\n$(big i4 i-1 i6)$vertices$faces"
refuses binary_n.off ':1: found nOFF BINARY' "nOFF BINARY\n$(big i3)$counts$vertices$faces"

# The name does not matter, but where the content leaves it open.
write content.obj "OFF\n4 4 6\n$corners$four"
check_loads content.obj 4 "$unit" ''
write content.mesh "COFF\n4 4 6\n$coloured$four"
check_loads content.mesh 4 "$unit" ''
finish_cases
