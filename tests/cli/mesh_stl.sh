#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# STL files of every kind that readers are known to differ on.
# shellcheck source=tests/cli/mesh_common.sh
. "$(dirname "$0")/mesh_common.sh"

unit='0 0 0, 1 1 1'

# facet A B C: in text.
facet() {
    printf 'facet normal 0 0 1\\n outer loop\\n  vertex %s\\n  vertex %s\\n  vertex %s\\n endloop\\nendfacet\\n' "$@"
}
facets=$(facet '0 0 0' '0 1 0' '1 0 0')$(facet '0 0 0' '1 0 0' '0 0 1')
facets+=$(facet '1 0 0' '0 1 0' '0 0 1')$(facet '0 0 0' '0 0 1' '0 1 0')
solid="solid cube\n${facets}endsolid cube\n"

# Text.
loads plain.stl 4 "$unit" "$solid"
loads end_solid.stl 4 "$unit" "${solid/endsolid/end solid}"
end_apart=${solid//endloop/end loop}
loads all_ends_apart.stl 4 "$unit" "${end_apart//endfacet/end facet}"
loads upper_case.stl 4 "$unit" "$(sed 's/[a-z]*/\U&/g; s/\\N/\\n/g' <<<"$solid")"
loads mixed_case.stl 4 "$unit" "$(sed 's/facet/Facet/g; s/vertex/Vertex/g; s/solid/Solid/' <<<"$solid")"
loads no_name.stl 4 "$unit" "solid\n${facets}endsolid\n"
loads no_end_name.stl 4 "$unit" "solid a b c\n${facets}endsolid"
loads other_end_name.stl 4 "$unit" "solid a\n${facets}endsolid b c\n"
loads name_of_words.stl 4 "$unit" "solid facet vertex endsolid #1\n${facets}endsolid\n"
loads name_of_bytes.stl 4 "$unit" "solid \x80\xff\n${facets}endsolid\n"
loads crlf.stl 4 "$unit" "$(sed 's/\\n/\\r\\n/g' <<<"$solid")"
loads cr.stl 4 "$unit" "$(sed 's/\\n/\\r/g' <<<"$solid")"
loads tabs.stl 4 "$unit" "$(sed 's/ /\\t/g' <<<"$solid")"
loads leading_blanks.stl 4 "$unit" "\n\n   $solid"
loads mark.stl 4 "$unit" "\xef\xbb\xbf$solid"
loads one_line.stl 4 "$unit" "$(sed 's/\\n/ /g' <<<"$solid")"
loads no_normal.stl 4 "$unit" "${solid//normal 0 0 1/}"
loads odd_normal.stl 4 "$unit" "${solid//normal 0 0 1/normal nan -nan(ind) 1.#QNAN}"
loads exponents.stl 1 '0 0 0, 1000 1e-07 0.5' "solid\n$(facet '0.000000e+00 0 0' '1E3 0 0' '0 1e-7 .5')endsolid\n"
loads round.stl 1 '0 0 0, 6.2572 1 0' "solid\n$(facet '0 0 0' '6.2572 0 0' '0 1 0')endsolid\n"
loads several.stl 5 '0 0 0, 6 1 1' "$solid\nsolid empty\nendsolid empty\nsolid more\n$(facet '5 0 0' '6 0 0' '5 1 0')endsolid more\n"
says 'several.stl: 5 primitives in 2 geometries'
loads trailing_text.stl 4 "$unit" "${solid}ende\n" 'its last 5 bytes, behind the mesh, are not read'
loads trailing_nul.stl 4 "$unit" "${solid}\x00\x00" 'its last 2 bytes, behind the mesh, are not read'
refuses nan.stl ":4: found 'nan'" "solid\n$(facet 'nan 0 0' '1 0 0' '0 1 0')endsolid\n"
refuses comma.stl ":5: found '0,5'" "solid\n$(facet '0 0 0' '0,5 0 0' '0 1 0')endsolid\n"
refuses two_numbers.stl ":6: found 'vertex'" "solid\n$(facet '0 0 0' '1 0' '0 1 0')endsolid\n"
refuses four_vertices.stl ":7: found 'vertex', allowed is 'endloop' behind three vertices" "solid\n$(facet '0 0 0' '1 0 0' '0 1 0\n vertex 1 1 1')endsolid\n"
refuses two_vertices.stl ":6: found 'endloop', allowed is 'vertex', three times" "solid\n$(facet '0 0 0' '1 0 0' '' | sed 's/\\n  vertex \\n/\\n/')endsolid\n"
refuses no_endsolid.stl "found the end of the file, allowed is 'facet' or 'endsolid'" "solid cube\n${facets}"
refuses cut.stl "found the end of the file, allowed is" "solid cube\n${facets%endfacet*}"
refuses cut_word.stl "found 'endso', allowed is 'facet' or 'endsolid'" "solid cube\n${facets}endso"
refuses misspelt.stl ":2: found 'face', allowed is 'facet' or 'endsolid'" "solid cube\nface normal 0 0 1\n"
refuses empty.stl 'holds no triangle' "solid\nendsolid\n"
refuses only_solid.stl ":1: found the end of the file" 'solid'
refuses letters.stl 'header promises' 'a text that is no mesh, and no STL header either'

# Binary.
header='bin\x00\x01'$(printf '\\x00%.0s' {1..75})
named='solid of the binary kind'$(printf ' %.0s' {1..56})
count=$(little i4) triangles=
for corners in '0 0 0 0 1 0 1 0 0' '0 0 0 1 0 0 0 0 1' '1 0 0 0 1 0 0 0 1' '0 0 0 0 0 1 0 1 0'; do
    # shellcheck disable=SC2086
    triangles+="$(little 0 0 0 $corners)\x00\x00"
done
loads binary.stl 4 "$unit" "$header$count$triangles"
loads binary_named.stl 4 "$unit" "$named$count$triangles"
named='solid x\nfacet normal 0 0 0\nouter loop\nvertex 0 0 0\n'$(printf ' %.0s' {1..29})
loads binary_facet.stl 4 "$unit" "$named$count$triangles"
loads binary_rest.stl 4 "$unit" "$header$count$triangles$(printf '\\x00%.0s' {1..16})" 'its last 16 bytes, behind the mesh, are not read'
loads binary_named_rest.stl 4 "$unit" "$named$count${triangles}some words" 'its last 10 bytes, behind the mesh, are not read'
loads binary_attributes.stl 4 "$unit" "$header$count${triangles//\\x00\\x00\\x00/\\x00\\x00\\x00}"
refuses binary_cut.stl 'header promises 4 triangles, but the file has 283 bytes, which hold 3' "$header$count${triangles%\\x00}"
refuses binary_more.stl 'header promises 5 triangles, but the file has 284 bytes, which hold 4' "$header$(little i5)$triangles"
refuses binary_hostile.stl 'header promises 4294967295 triangles' "$header$(little i-1)$triangles"
refuses binary_none.stl 'holds no triangle' "$header$(little i0)"
refuses binary_short.stl 'header promises 0 triangles, but the file has 80 bytes' "$header"

# A NaN of a binary file is loaded; its triangle is skipped and counted.
write binary_nan.stl "$header$count${triangles/\\x00\\x00\\x80\\x3f/\\x00\\x00\\xc0\\x7f}"
expect 0 info binary_nan.stl -a linear
says "1 invalid primitives, first (geometry/primitive) 0/0"

# The name does not matter.
write binary.ply "$header$count$triangles"
check_loads binary.ply 4 "$unit" ''
write text.dat "$solid"
check_loads text.dat 4 "$unit" ''
finish_cases
