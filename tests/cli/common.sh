# SPDX-License-Identifier: Apache-2.0
# For the tests of the command: sourced with the path of build/accel as first argument. Works in a
# folder of its own, which is removed at the end.
set -euo pipefail
accel=$(realpath "$1")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
failures=0

# A kind that this build has: not linear where there is another one.
kinds=$("$accel" kinds | sed '/^Built-in/,$d' | grep -oE '^[a-z]+ ' | tr -d ' ')
kind=$(grep -vxE 'linear|auto' <<<"$kinds" | head -n 1 || true)
kind=${kind:-linear}

fail() {
    echo "FAIL: $*" >&2
    failures=$((failures + 1))
}

# expect CODE ARGUMENT...: runs accel, keeps its output in out and err, compares the exit code.
expect() {
    local wanted=$1 got=0
    shift
    timeout 120 "$accel" "$@" >out 2>err </dev/null || got=$?
    [ "$got" = "$wanted" ] || fail "accel $* exits with $got instead of $wanted: $(head -c 300 err)"
}

# complains WORDS ARGUMENT...: accel exits with 2 after one clear line that holds WORDS, prints no
# result, and leaves no file behind.
complains() {
    local words=$1 before after
    shift
    before=$(ls -A . | grep -v -x -e out -e err || true)
    expect 2 "$@"
    after=$(ls -A . | grep -v -x -e out -e err || true)
    [ "$(wc -l <err)" = 1 ] || fail "accel $* prints $(wc -l <err) lines instead of one"
    grep -qF -e "$words" err || fail "accel $* says '$(head -c 300 err)', not '$words'"
    [ ! -s out ] || fail "accel $* prints a result beside its complaint"
    [ "$before" = "$after" ] || fail "accel $* leaves a file behind"
}

# says WORDS: the output of the last expect holds them.
says() {
    grep -qF -e "$1" out || fail "the output does not say '$1': $(head -c 300 out)"
}

finish() {
    [ "$failures" = 0 ] || exit 1
}

# A tetrahedron in every format that a test can write by hand.
write_meshes() {
    local corners="0 0 0\n1 0 0\n0 1 0\n0 0 1\n" faces="3 0 1 2\n3 0 1 3\n3 0 2 3\n3 1 2 3\n"
    local header="element vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
    header+="element face 4\nproperty list uchar int vertex_indices\nend_header\n"
    printf "ply\nformat ascii 1.0\n$header$corners$faces" >text.ply
    {
        printf "ply\nformat binary_little_endian 1.0\n$header"
        local zero='\0\0\0\0' one='\0\0\200\077'
        printf "$zero$zero$zero$one$zero$zero$zero$one$zero$zero$zero$one"
        local i=('\0\0\0\0' '\1\0\0\0' '\2\0\0\0' '\3\0\0\0')
        printf "\3${i[0]}${i[1]}${i[2]}\3${i[0]}${i[1]}${i[3]}"
        printf "\3${i[0]}${i[2]}${i[3]}\3${i[1]}${i[2]}${i[3]}"
    } >binary.ply
    printf "OFF\n# a comment\n4 4 0\n$corners$faces" >text.off
    {
        printf "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n"
        printf "f 1 2 3\nf 1 2 4\nf 1 3 4\nf 2 3 4\n"
    } >text.obj
    {
        echo "solid s"
        local a='0 0 0' b='1 0 0' c='0 1 0' d='0 0 1' face
        for face in "$a|$b|$c" "$a|$b|$d" "$a|$c|$d" "$b|$c|$d"; do
            echo "facet normal 0 0 0"
            echo "outer loop"
            tr '|' '\n' <<<"$face" | sed 's/^/vertex /'
            printf "endloop\nendfacet\n"
        done
        echo "endsolid s"
    } >text.stl
}
