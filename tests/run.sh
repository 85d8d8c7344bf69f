#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# Installs what the tests need, builds, runs the tests, ends with what was left out and with ctest's
# exit code.
set -euo pipefail
# shellcheck source=scenes/prepare.sh
. "$(dirname "${BASH_SOURCE[0]}")/../scenes/prepare.sh"

usage() {
    cat <<'HELP'
usage: tests/run.sh [--fast | --long] [CTEST-OPTION...]
Installs missing packages (apt; sudo where not root), builds into build/, fetches the real meshes,
and runs the tests:
  --fast  library and command, in small: under two minutes, without POV-Ray and meshes
          the whole suite, by default: ten minutes on two cores, once POV-Ray is built
  --long  the same, and then every step of tests/long.sh: hours
Options go to ctest: -R NAME runs those whose name matches, -N lists them. ACCEL_TEST_INTENSITY
scales the counts: tests/library/CMakeLists.txt says of what.
Where POV-Ray's source or a mesh cannot be downloaded, what needs it is skipped, and said so at the
end; with CI=true it is an error.
HELP
}

tier=whole
case "${1:-}" in
--help | -h) usage && exit 0 ;;
--fast | --long) tier=${1#--} && shift ;;
esac

if [ "$tier" = fast ]; then
    prepare fast
    export ACCEL_TEST_INTENSITY=${ACCEL_TEST_INTENSITY:-0.05}
    exec ctest --test-dir "$build" --output-on-failure -j "$(nproc)" -LE 'povray|slow' "$@"
fi

# bring WHAT COMMAND...: what some tests need, and the others can do without if the download fails.
missing=()
bring() {
    local what=$1 status=0
    shift
    "$@" || status=$?
    if [ $status -eq 75 ] && [ "${CI:-}" != true ]; then
        missing+=("$what")
    elif [ $status -ne 0 ]; then
        die "$what: see above"
    fi
}

prepare tests
bring "the patched POV-Ray" build_povray
for mesh in teapots museum dragon; do
    bring "the meshes of '$mesh'" "$root/scenes/fetch.sh" "$mesh"
done
status=0
ctest --test-dir "$build" --output-on-failure -j "$(nproc)" "$@" || status=$?
if [ "$tier" = long ]; then
    "$root/tests/long.sh" || status=1
fi
for what in "${missing[@]}"; do
    say "NOT TESTED, as a download failed: what needs $what"
done
exit $status
