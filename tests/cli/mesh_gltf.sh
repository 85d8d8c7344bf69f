#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# glTF files of every kind that readers are known to differ on.
# shellcheck source=tests/cli/mesh_common.sh
. "$(dirname "$0")/mesh_common.sh"

unit='0 0 0, 1 1 1'

# What a case may replace. The buffer: four corners as float, twelve indices of 16 bits.
asset='{"version":"2.0"}'
scenes='[{"nodes":[0]}]'
nodes='[{"mesh":0}]'
meshes='[{"primitives":[{"attributes":{"POSITION":0},"indices":1}]}]'
places='{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3","min":[0,0,0],"max":[1,1,1]}'
indices='{"bufferView":1,"componentType":5123,"count":12,"type":"SCALAR"}'
more_accessors=
views='[{"buffer":0,"byteOffset":0,"byteLength":48},{"buffer":0,"byteOffset":48,"byteLength":24}]'
more=
short() { perl -e 'print map { sprintf "\\x%02x", $_ } unpack("C*", pack("v*", @ARGV))' "$@"; }
corners=$(little 0 0 0 1 0 0 0 1 0 0 0 1)
bytes=$corners$(short 0 2 1 0 1 3 1 2 3 0 3 2)

# json URI: the document; URI is that of the buffer, with its key and a comma, or empty.
json() {
    printf '{"asset":%s,"scene":0,"scenes":%s,"nodes":%s,"meshes":%s,"accessors":[%s,%s%s],' \
        "$asset" "$scenes" "$nodes" "$meshes" "$places" "$indices" "$more_accessors"
    printf '"bufferViews":%s,"buffers":[{%s"byteLength":%d}]%s}' "$views" "$1" \
        "$(printf '%b' "$bytes" | wc -c)" "$more"
}

# content NAME: the file as escapes, by the ending of its name.
content() {
    local text size
    if [ "${1##*.}" = gltf ]; then
        json '"uri":"data:application/octet-stream;base64,'"$(printf '%b' "$bytes" | base64 -w 0)"'",'
        return
    fi
    text=$(json '')
    while [ $((${#text} % 4)) != 0 ]; do text+=' '; done
    size=$(printf '%b' "$bytes" | wc -c)
    printf 'glTF%s%s%s%s%s%s' "$(little i2 "i$((28 + ${#text} + size))")" "$(little "i${#text}")" \
        JSON "$text" "$(little "i$size")" "BIN\\x00$bytes"
}

ok() { loads "$1" "$2" "$3" "$(content "$1")" "${4:-}"; }
no() { refuses "$1" "$2" "$(content "$1")"; }

# The file.
ok plain.glb 4 "$unit"
ok plain.gltf 4 "$unit"
glb=$(content x.glb)
loads glb_rest.glb 4 "$unit" "${glb}abc" 'its last 3 bytes'
loads mark.gltf 4 "$unit" "\xef\xbb\xbf$(content x.gltf)"
loads content.bin 4 "$unit" "$glb"
loads content.json 4 "$unit" "$(content x.gltf)"
refuses glb_cut.glb 'is a GLB of version 2 and' "${glb%\\x00}"
refuses glb_version.glb 'is a GLB of version 1' "${glb/glTF\\x02/glTF\\x01}"
refuses glb_short.glb 'is a GLB of version 0' 'glTF\x02\x00\x00\x00'
refuses glb_chunk.glb ', byte 13: a chunk of' "${glb/JSON/JSOM}"
refuses json.gltf ':1: no JSON in column' '{"asset":{"version":"2.0"},'
refuses json_twice.gltf 'no JSON in column' '{"asset":{"version":"2.0"},"asset":{}}'
asset='{"version":"1.0"}' no version_1.gltf "is glTF of version '1.0', allowed is 2.0"
asset='{}' no version_none.gltf 'is glTF of version none'
asset='{"version":"2.0","minVersion":"2.1"}' no version_least.gltf "requires glTF of version '2.1'"
asset='{"version":"2.0","minVersion":"2.0"}' ok version_fine.gltf 4 "$unit"

# Buffers.
printf '%b' "$bytes" >'a buffer.bin'
loads beside.gltf 4 "$unit" "$(json '"uri":"a%20buffer.bin",')"
loads beside_dot.gltf 4 "$unit" "$(json '"uri":"./a buffer.bin",')"
refuses other_folder.gltf "refers to 'x/a.bin', allowed is a file in the folder" "$(json '"uri":"x/a.bin",')"
refuses upper_folder.gltf "refers to '../a.bin'" "$(json '"uri":"../a.bin",')"
refuses upper_escaped.gltf "refers to '%2e%2e%2fa.bin'" "$(json '"uri":"%2e%2e%2fa.bin",')"
refuses absolute.gltf "refers to '/etc/passwd'" "$(json '"uri":"/etc/passwd",')"
refuses web.gltf "refers to 'http://x/a.bin'" "$(json '"uri":"http://x/a.bin",')"
write missing.gltf "$(json '"uri":"none.bin",')"
complains 'none.bin: No such file' info missing.gltf
refuses no_uri.gltf 'buffers[0] has no uri' "$(json '')"
refuses bad_base64.gltf 'not in base64' "$(json '"uri":"data:application/octet-stream;base64,AA*A",')"
refuses not_base64.gltf 'not in base64' "$(json '"uri":"data:text/plain,abc",')"
refuses short_buffer.gltf 'buffers[0] has 72 bytes by its byteLength, but only 3 are there' "$(json '"uri":"data:application/octet-stream;base64,AAAA",')"
views='[{"buffer":0,"byteOffset":0,"byteLength":48},{"buffer":0,"byteOffset":48,"byteLength":25}]' no view_beyond.gltf 'bufferViews[1] has bytes 48 to 73 of a buffer of 72'
views='[{"buffer":7,"byteLength":48},{"buffer":0,"byteOffset":48,"byteLength":24}]' no no_buffer.gltf 'refers to buffers[7], but there are 1'

# Accessors.
places=${places/VEC3/VEC2} no vec2.gltf 'accessors[0] is used for POSITION, allowed is VEC3'
places=${places/5126/5130} no other_type.gltf 'accessors[0] has componentType 5130'
places=${places/4,/5,} no beyond.gltf 'accessors[0] needs bytes 0 to 60 of bufferViews[0], which has 48'
places=${places/4,/4000000000,} no hostile.gltf 'accessors[0] needs bytes 0 to 48000000000'
places=${places/4,/1e300,} no huge.gltf 'accessors[0] has a count that is no whole number'
places=${places/4,/-4,} no negative.gltf 'accessors[0] has a count'
places=${places/4,/4.5,} no fraction.gltf 'accessors[0] has a count'
places=${places/4,/4.0,} ok whole_real.gltf 4 "$unit"
places=${places/\"bufferView\":0/\"bufferView\":9} no no_view.gltf 'refers to bufferViews[9], but there are 2'
places=${places/\"count\":4,/} no no_count.gltf 'accessors[0] has no count'
bytes="\x01\x02\x03\x04$corners$(short 0 2 1 0 1 3 1 2 3 0 3 2)" places=${places/\"bufferView\":0/\"bufferView\":0,\"byteOffset\":4} \
    views='[{"buffer":0,"byteLength":52},{"buffer":0,"byteOffset":52,"byteLength":24}]' ok offset.gltf 4 "$unit"
bytes=$(little 0 0 0 9 1 0 0 9 0 1 0 9 0 0 1)$(short 0 2 1 0 1 3 1 2 3 0 3 2) \
    views='[{"buffer":0,"byteLength":60,"byteStride":16},{"buffer":0,"byteOffset":60,"byteLength":24}]' ok stride.gltf 4 "$unit"
views='[{"buffer":0,"byteLength":48,"byteStride":8},{"buffer":0,"byteOffset":48,"byteLength":24}]' no small_stride.gltf 'accessors[0] has elements of 12 bytes every 8 bytes'
sparse='"sparse":{"count":2,"indices":{"bufferView":2,"componentType":5121},"values":{"bufferView":3}}'
sparse_views=${views%]},'{"buffer":0,"byteOffset":72,"byteLength":2},{"buffer":0,"byteOffset":74,"byteLength":24}]'
sparse_bytes=$bytes'\x01\x03'$(little 5 0 0 0 0 7)
places=${places%\}},$sparse} views=$sparse_views bytes=$sparse_bytes ok sparse.gltf 4 '0 0 0, 5 1 7'
places='{"componentType":5126,"count":4,"type":"VEC3",'$sparse} views=$sparse_views bytes=$sparse_bytes ok sparse_zero.gltf 4 '0 0 0, 5 0 7'
places=${places%\}},$sparse} views=$sparse_views bytes=${sparse_bytes/\\x01\\x03/\\x01\\x04} no sparse_beyond.gltf 'accessors[0] has sparse indices that do not rise, or'
places=${places%\}},$sparse} views=$sparse_views bytes=${sparse_bytes/\\x01\\x03/\\x03\\x01} no sparse_falls.gltf 'accessors[0] has sparse indices'

# Quantized coordinates: as they are, or normalized, and only where the extension is named.
short_places='{"bufferView":0,"componentType":5122,"count":4,"type":"VEC3"}'
short_views='[{"buffer":0,"byteLength":32,"byteStride":8},{"buffer":0,"byteOffset":32,"byteLength":24}]'
short_bytes=$(short 0 0 0 0 1000 0 0 0 0 1000 0 0 0 0 1000 0)$(short 0 2 1 0 1 3 1 2 3 0 3 2)
quantized=',"extensionsRequired":["KHR_mesh_quantization"],"extensionsUsed":["KHR_mesh_quantization"]'
places=$short_places views=$short_views bytes=$short_bytes more=$quantized nodes='[{"mesh":0,"scale":[0.001,0.001,0.001]}]' ok quantized.glb 4 "$unit"
places=$short_places views=$short_views bytes=$short_bytes nodes='[{"mesh":0}]' no not_quantized.gltf 'accessors[0] is used for POSITION'
short_bytes=$(short 0 0 0 0 32767 0 0 0 0 32767 0 0 0 0 32769 0)$(short 0 2 1 0 1 3 1 2 3 0 3 2)
places=${short_places/,/,\"normalized\":true,} views=$short_views bytes=$short_bytes more=$quantized ok normalized.glb 4 '0 0 -1, 1 1 0'
byte_views='[{"buffer":0,"byteLength":16,"byteStride":4},{"buffer":0,"byteOffset":16,"byteLength":24}]'
byte_bytes='\x00\x00\x00\x00\xff\x00\x00\x00\x00\xff\x00\x00\x00\x00\xff\x00'$(short 0 2 1 0 1 3 1 2 3 0 3 2)
places=${short_places/5122/5121} views=$byte_views bytes=$byte_bytes more=$quantized ok bytes.glb 4 '0 0 0, 255 255 255'
places=${short_places/5122/5120} views=$byte_views bytes=$byte_bytes more=$quantized ok signed_bytes.glb 4 '-1 -1 -1, 0 0 0'

# Primitives.
primitive() { printf '[{"primitives":[{"attributes":{"POSITION":0}%s}%s]}]' "$1" "${2:-}"; }
meshes=$(primitive ',"indices":1' ',{"attributes":{"POSITION":0},"mode":1}') ok lines.glb 4 "$unit" '2 points and lines are left out'
expect 0 export lines.glb -o lines.inc
grep -q '^// 4 triangles in 1 geometries' lines.inc || fail "the export of lines.glb: $(head -n 1 lines.inc)"
meshes=$(primitive ',"mode":0') no points.gltf 'holds no triangle; 4 points and lines are there'
meshes=$(primitive ',"mode":2') no loop.gltf 'holds no triangle; 4 points and lines'
meshes=$(primitive ',"mode":3') no line_strip.gltf 'holds no triangle; 3 points and lines'
meshes=$(primitive ',"mode":5') ok strip.gltf 2 "$unit"
meshes=$(primitive ',"mode":6') ok fan.gltf 2 "$unit"
meshes=$(primitive ',"indices":1,"mode":5') ok strip_indexed.gltf 10 "$unit"
meshes=$(primitive ',"mode":7') no mode.gltf 'meshes[0] has a mode'
meshes=$(primitive '') no four_corners.gltf 'meshes[0] has a primitive of 4 corners, which are no triangles'
meshes=$(primitive '') places=${places/4,/3,} ok not_indexed.gltf 1 '0 0 0, 1 1 0'
meshes='[{"primitives":[{"attributes":{"NORMAL":0},"indices":1}]}]' no no_position.gltf 'meshes[0] has no POSITION'
meshes='[{"primitives":[]}]' no no_primitives.gltf 'meshes[0] has no primitives'
meshes='[{"primitives":[3]}]' no odd_primitive.gltf 'meshes[0] has a primitive that is no object'
bytes=$corners$(short 0 2 1 0 1 3 1 2 4 0 3 2) no index_beyond.gltf 'meshes[0] has a primitive that refers to vertex 4 of 4'
bytes=$corners$(short 0 2 1 0 1 3 1 2 65535 0 3 2) no restart.gltf 'refers to vertex 65535 of 4'
indices=${indices/5123/5126} no float_indices.gltf 'accessors[1] needs bytes'
indices=${indices/5123/5122} no signed_indices.gltf 'accessors[1] is used for indices'
bytes=$corners'\x00\x02\x01\x00\x01\x03\x01\x02\x03\x00\x03\x02'$(little 0 0 0) indices=${indices/5123/5121} ok byte_indices.gltf 4 "$unit"
bytes=$corners$(little i0 i2 i1 i0 i1 i3) indices='{"bufferView":1,"componentType":5125,"count":6,"type":"SCALAR"}' ok long_indices.gltf 2 "$unit"
bytes=$corners$(short 3 1 0 0 0 0 0 0 0 0 0 0) indices=${indices/\"count\":12/\"count\":3} ok few_used.gltf 1 '0 0 0, 1 0 1'
expect 0 export few_used.gltf -o few_used.inc --as triangles
grep -qxF '{<0,0,1>,<1,0,0>,<0,0,0>}' few_used.inc || fail "the corners of few_used.gltf: $(tail -n 2 few_used.inc)"

# Nodes.
nodes='[{"mesh":0,"translation":[10,0,0],"scale":[2,2,2]}]' ok moved.gltf 4 '10 0 0, 12 2 2'
nodes='[{"mesh":0,"rotation":[0,0,0.70710678118654757,0.70710678118654757]}]' ok turned.gltf 4 '-1 -2.22044605e-16 0, 0 1 1'
nodes='[{"mesh":0,"rotation":[0,0,2,0]}]' ok not_unit.gltf 4 '-1 -1 0, 0 0 1'
nodes='[{"mesh":0,"matrix":[1,0,0,0,0,2,0,0,0,0,3,0,4,5,6,1]}]' ok matrix.gltf 4 '4 5 6, 5 7 9'
nodes='[{"children":[1],"translation":[1,0,0]},{"children":[2,3],"scale":[2,2,2]},{"mesh":0,"translation":[1,0,0]},{"mesh":0}]' ok nested.gltf 8 '1 0 0, 5 2 2'
says 'nested.gltf: 8 primitives in 2 geometries'
nodes='[{"mesh":0,"translation":[0.1,0,0],"children":[1]},{"translation":[0.2,0,0],"mesh":0}]' ok double.gltf 8 '0.1 0 0, 1.3 1 1'
nodes='[{"mesh":0},{"mesh":0}]' scenes='[{"nodes":[0,1]}]' ok two.gltf 8 "$unit"
nodes='[{"mesh":0},{"mesh":0}]' ok not_in_scene.gltf 4 "$unit"
nodes='[{"children":[0]}]' no cycle.gltf 'nodes[0] is there twice in the scene'
nodes='[{"children":[1,1]},{"mesh":0}]' no shared.gltf 'nodes[1] is there twice in the scene'
nodes='[{"children":[5]}]' no no_child.gltf 'nodes[0] has a node in children that is not there'
nodes='[{"mesh":5}]' no no_mesh.gltf 'refers to meshes[5], but there are 1'
nodes='[{"mesh":0,"translation":[1,2]}]' no two_numbers.gltf 'nodes[0] has a translation that is not 3 numbers'
nodes='[{"mesh":0,"scale":"big"}]' no no_numbers.gltf 'nodes[0] has a scale that is not 3 numbers'
nodes='[{"mesh":0,"rotation":[0,0,0,0]}]' no no_rotation.gltf 'nodes[0] has a rotation of length 0'
nodes='[{"mesh":0,"matrix":[1,0,0,1,0,1,0,0,0,0,1,0,0,0,0,1]}]' no projective.gltf 'nodes[0] has a matrix whose last row'
scenes='[]' no no_scene.gltf 'has no scene'
scenes='[{}]' no empty_scene.gltf 'holds no triangle'
more=',"extras":{"scene":1}' ok extras.gltf 4 "$unit"
deep=$(for ((i = 0; i < 20000; i++)); do printf '{"children":[%d],"translation":[1,0,0]},' $((i + 1)); done)
one_node=$nodes nodes="[$deep{\"mesh\":0}]"
ok deep.gltf 4 '20000 0 0, 20001 1 1'
nodes=$one_node

# Morph targets and skins.
target=',"indices":1,"targets":[{"POSITION":2}]'
moves=',{"bufferView":2,"componentType":5126,"count":4,"type":"VEC3"}'
move_views=${views%]},'{"buffer":0,"byteOffset":72,"byteLength":48}]'
move_bytes=$bytes$(little 0 0 0 2 0 0 0 0 0 0 0 0)
meshes="$(primitive "$target" | sed 's/}]$/,"weights":[0.5]}]/')" more_accessors=$moves views=$move_views bytes=$move_bytes ok morph.gltf 4 '0 0 0, 2 1 1'
meshes="$(primitive "$target" | sed 's/}]$/,"weights":[0.5]}]/')" nodes='[{"mesh":0,"weights":[1]}]' more_accessors=$moves views=$move_views bytes=$move_bytes ok morph_node.gltf 4 '0 0 0, 3 1 1'
meshes=$(primitive "$target") more_accessors=$moves views=$move_views bytes=$move_bytes ok morph_rest.gltf 4 "$unit"
meshes="$(primitive "$target" | sed 's/}]$/,"weights":[1,2]}]/')" more_accessors=$moves views=$move_views bytes=$move_bytes no morph_weights.gltf 'meshes[0] has 1 morph targets, but not as many weights'
skinned='[{"primitives":[{"attributes":{"POSITION":0,"JOINTS_0":2,"WEIGHTS_0":3},"indices":1}]}]'
skin_accessors=',{"bufferView":2,"componentType":5121,"count":4,"type":"VEC4"},{"bufferView":3,"componentType":5126,"count":4,"type":"VEC4"},{"bufferView":4,"componentType":5126,"count":2,"type":"MAT4"}'
skin_views=${views%]},'{"buffer":0,"byteOffset":72,"byteLength":16},{"buffer":0,"byteOffset":88,"byteLength":64},{"buffer":0,"byteOffset":152,"byteLength":128}]'
skin_bytes=$bytes'\x00\x00\x00\x00\x01\x00\x00\x00\x00\x01\x00\x00\x00\x00\x00\x00'$(little 1 0 0 0 1 0 0 0 .5 .5 0 0 2 0 0 0 \
    1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1 1 0 0 0 0 1 0 0 0 0 1 0 -1 0 0 1)
skin_nodes='[{"children":[1,2,3]},{"mesh":0,"skin":0,"translation":[100,0,0]},{},{"translation":[5,0,0]}]'
skins=',"skins":[{"joints":[2,3],"inverseBindMatrices":4}]'
meshes=$skinned more_accessors=$skin_accessors views=$skin_views bytes=$skin_bytes nodes=$skin_nodes more=$skins ok skin.gltf 4 '0 0 0, 5 1 1'
meshes=$skinned more_accessors=$skin_accessors views=$skin_views bytes=$skin_bytes nodes=$skin_nodes more=',"skins":[{"joints":[2,3]}]' ok skin_plain.gltf 4 '0 0 0, 6 1 1'
meshes=$skinned more_accessors=$skin_accessors views=$skin_views bytes=$skin_bytes nodes=$skin_nodes more=',"skins":[{"joints":[2]}]' no skin_joint.gltf 'meshes[0] refers to joint 1 of 1'
meshes=$skinned more_accessors=$skin_accessors views=$skin_views bytes=$skin_bytes nodes=$skin_nodes more=',"skins":[{"joints":[2,9]}]' no skin_node.gltf 'skins[0] has a joint that is not in the scene'

# Extensions.
required() { printf ',"extensionsUsed":["%s"],"extensionsRequired":["%s"]' "$1" "$1"; }
more=$(required KHR_draco_mesh_compression) no draco.gltf "requires the extension 'KHR_draco_mesh_compression', which is not supported"
more=$(required EXT_meshopt_compression) no meshopt.gltf "requires the extension 'EXT_meshopt_compression'"
more=$(required EXT_mesh_gpu_instancing) no instancing.gltf "requires the extension 'EXT_mesh_gpu_instancing'"
more=$(required VENDOR_unknown) no vendor.gltf "requires the extension 'VENDOR_unknown'"
more=$(required KHR_materials_unlit) ok unlit.gltf 4 "$unit"
more=$(required KHR_texture_transform) ok texture.gltf 4 "$unit"
more=',"extensionsUsed":["EXT_mesh_gpu_instancing"]' ok may_instance.gltf 4 "$unit" "its extension 'EXT_mesh_gpu_instancing' is passed over"
more=',"extensionsRequired":[7]' no odd_extension.gltf 'extensionsRequired[0] is no name'

# Many instances of a large mesh: they load, or the line says what they need. 600 of 80,000 triangles
# take 1.1 GB, of which the file says nothing.
perl -e 'binmode STDOUT; for $y (0 .. 200) { print pack("f<3", $_, $y, 0) for 0 .. 200 }
    for $y (0 .. 199) { for $x (0 .. 199) { $a = 201 * $y + $x;
        print pack("V6", $a, $a + 1, $a + 201, $a + 1, $a + 202, $a + 201) } }' >grid.bin
instances() {
    perl -e '$n = shift; print qq({"asset":{"version":"2.0"},"scenes":[{"nodes":[), join(",", 0 .. $n - 1), qq(]}],"nodes":[),
        join(",", map { qq({"mesh":0,"translation":[0,0,$_]}) } 0 .. $n - 1), qq(],
        "meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1}]}],
        "accessors":[{"bufferView":0,"componentType":5126,"count":40401,"type":"VEC3"},
        {"bufferView":1,"componentType":5125,"count":240000,"type":"SCALAR"}],
        "bufferViews":[{"buffer":0,"byteLength":484812},{"buffer":0,"byteOffset":484812,"byteLength":960000}],
        "buffers":[{"uri":"grid.bin","byteLength":1444812}]})' "$1"
}
instances 60 >instances_60.gltf
cases=$((cases + 2))
check_loads instances_60.gltf 4800000 '0 0 0, 200 200 59' ''
says 'instances_60.gltf: 4800000 primitives in 60 geometries'
# sanitizers map more than the limit before the command begins
if (ulimit -v 1000000 && "$accel" --version) >out 2>&1; then
    instances 600 >instances_600.gltf
    (ulimit -v 1000000 && timeout 60 "$accel" info instances_600.gltf -a linear) >out 2>err &&
        fail "600 instances fit into 1 GB"
    grep -qE '^accel info: instances_600.gltf: shows 600 meshes of 48000000 triangles together, which take [0-9]+ MB of memory, but [0-9]+ MB are free: free some; nothing was loaded$' err ||
        fail "600 instances in 1 GB: $(cat err)"
fi
finish_cases
