#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
#
# Ctrl-C while the structure is being built: POV-Ray must end with 2, its code for that, before the
# build is done. The build says where it is once a second; that is when it is stopped.
set -euo pipefail
# shellcheck source=tests/povray/common.sh
. "$(dirname "${BASH_SOURCE[0]}")/common.sh"

here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)

# stop_build COUNT: sets `code`; false if the build was done before it said anything
stop_build() {
    "$ours" -D +W8 +H6 +WT1 +I"$here/many.pov" Declare=Count="$1" +BM3 \
        Accelerator=octree:leaf=1,depth=14 +Ostop.png >stop.log 2>&1 </dev/null &
    local pid=$!
    until grep -qa 'Building accelerator' stop.log; do
        if ! kill -0 $pid 2>/dev/null; then
            wait $pid || die "POV-Ray failed: see $PWD/stop.log"
            return 1
        fi
        sleep 0.02
    done
    kill -INT $pid
    code=0
    wait $pid || code=$?
}

need_binaries
mkdir -p "$build/tests/stop"
cd "$build/tests/stop"
for count in 400000 1600000 3200000; do
    # a build that was done before the signal came says nothing: a longer one has to be stopped
    if stop_build $count && ! grep -qa 'Build time' stop.log; then
        [ "$code" -eq 2 ] || die "exit code $code, not 2: see $PWD/stop.log"
        echo "stopped while building over $count spheres"
        exit 0
    fi
done
die "no build was stopped, not even that over $count spheres: see $PWD/stop.log"
