#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# Installs the package as a user does, but without a network, into a virtual environment of its own,
# and runs its tests there. The source's folder is left as it was.
#
#     install.sh ACCEL LAYOUT     the command, and the program that prints the layouts of accel.h
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
# shellcheck source=tests/scratch.sh
. "$here/../scratch.sh"
unset ACCEL_LIBRARY PYTHONPATH

# A python3 that has what Debian's packages bring; another may stand before it in PATH.
python=
for candidate in python3 /usr/bin/python3; do
    if "$candidate" -c 'import ensurepip, numpy, setuptools, venv, wheel' 2>"$work/missing"; then
        python=$candidate
        break
    fi
done
[ -n "$python" ] ||
    fail "$(tail -n 1 "$work/missing"); packages: python3-{numpy,pip,setuptools,venv,wheel}"

# A copy without what an editable install or a build by hand has left there.
mkdir "$work/source"
cp -a "$here/../../accel" "$work/source/"
rm -rf "$work/source/accel/python/src/accel/libaccel.so"
(cd "$work/source" && find . -not -path '*/__pycache__*' | sort) >"$work/before"

quietly "venv" "$python" -m venv --system-site-packages "$work/venv"
quietly "pip install" "$work/venv/bin/pip" install --no-index --no-build-isolation --no-deps \
    "$work/source/accel/python"
(cd "$work/source" && find . -not -path '*/__pycache__*' | sort) >"$work/after"
diff "$work/before" "$work/after" >&2 || fail "pip install changed the folder of the source"

export ACCEL_TEST_COMMAND=$1 ACCEL_TEST_LAYOUT=$2 ACCEL_TEST_BUNDLED=$work/venv
cd "$work"
"$work/venv/bin/python" -m unittest discover -s "$here"
