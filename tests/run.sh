#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# Installs what the tests need, builds, runs every test, ends with ctest's summary.
set -euo pipefail
# shellcheck source=scenes/prepare.sh
. "$(dirname "${BASH_SOURCE[0]}")/../scenes/prepare.sh"

if [ "${1:-}" = --help ]; then
    cat <<'HELP'
usage: tests/run.sh [CTEST-OPTION...]
Installs missing packages (apt; sudo where not root), builds into build/, fetches the real meshes,
and runs all tests. Options go to ctest: -R NAME runs those whose name matches, -N lists them.
HELP
    exit 0
fi

prepare tests
"$root/scenes/fetch.sh" all
exec ctest --test-dir "$build" --output-on-failure -j "$(nproc)" "$@"
