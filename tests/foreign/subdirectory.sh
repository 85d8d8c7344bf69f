#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# A stranger's CMake project adds accel/ alone, or the whole tree, and compiles everything for speed:
# the answers keep their bits.
#
#     subdirectory.sh HOST LANGUAGE FOLDER FLAG...
# shellcheck source=tests/foreign/common.sh
. "$(dirname "${BASH_SOURCE[0]}")/common.sh"

stranger "$3 in $2 with ${*:4}" "$2" "-DACCEL_SOURCE=$3" -DCMAKE_BUILD_TYPE=Release \
    "-DCMAKE_C_FLAGS_RELEASE=${*:4}" "-DCMAKE_CXX_FLAGS_RELEASE=${*:4}"
