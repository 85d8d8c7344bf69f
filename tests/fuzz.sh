#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# Fuzzes every target of tests/fuzz with libFuzzer and sanitizers: too long for tests/run.sh, which
# runs the targets on their corpus.
set -euo pipefail
# shellcheck source=scenes/prepare.sh
. "$(dirname "${BASH_SOURCE[0]}")/../scenes/prepare.sh"

if [ "${1:-}" = --help ]; then
    cat <<'HELP'
usage: tests/fuzz.sh [MINUTES [TARGET...]]
       tests/fuzz.sh --merge
Builds the preset fuzz (clang) into build-fuzz/ and runs each TARGET (default: all) for MINUTES
(default 1), starting from tests/fuzz/corpus and what earlier runs left in build-fuzz/corpus. Prints
executions, hours, covered edges and findings of each. Inputs that fail go to build-fuzz/findings;
build-fuzz/tests/fuzz/fuzz_TARGET FILE runs one again. Ends with 1 where there are any.
--merge takes the inputs of build-fuzz/corpus that cover more edges into tests/fuzz/corpus.
HELP
    exit 0
fi

fuzz=$root/build-fuzz
source=$root/tests/fuzz
merge=0
minutes=1
if [ "${1:-}" = --merge ]; then
    merge=1
elif [ $# -gt 0 ]; then
    minutes=$1
fi
[ $# -eq 0 ] || shift
[[ $minutes =~ ^[1-9][0-9]{0,4}$ ]] || bad_usage "'$minutes' minutes; 1 to 99999 are allowed"
targets=("$@")
[ $# -gt 0 ] || mapfile -t targets < <(cd "$source/corpus" && ls)
for target in "${targets[@]}"; do
    [ -d "$source/corpus/$target" ] || bad_usage "no target '$target'"
done

install_missing "${packages_build[@]}" "${packages_tests[@]}"
cd "$root"
step "configure the fuzz targets" cmake --preset fuzz
step "build the fuzz targets" cmake --build --preset fuzz -j "$(nproc)"

# Inputs beyond these sizes only take time.
longest() {
    case $1 in
    agree) echo 1000 ;;
    config) echo 300 ;;
    *) echo 4096 ;;
    esac
}

# run TARGET SECONDS: one run of the fuzzer, which ends with its first finding.
run() {
    "$fuzz/tests/fuzz/fuzz_$1" -max_total_time="$2" -max_len="$(longest "$1")" -len_control=20 \
        -entropic_scale_per_exec_time=1 -timeout=30 -rss_limit_mb=2048 -print_final_stats=1 \
        -artifact_prefix="$fuzz/findings/$1-" "$fuzz/corpus/$1" "$source/corpus/$1"
}

# found TARGET: how many findings there are; '*' stands for all targets.
found() {
    find "$fuzz/findings" -name "$1-*" -regex '.*-\(crash\|leak\|timeout\|oom\)-[0-9a-f]*' | wc -l
}

# What a log says: the sum of executions, and the most edges.
executions() {
    awk '/^stat::number_of_executed_units/ { n += $2 } END { print n + 0 }' "$1"
}
edges() {
    awk '{ for (i = 1; i < NF; i++) if ($i == "cov:" && $(i + 1) > n) n = $(i + 1) }
         END { print n + 0 }' "$1"
}

# Runs one target until its time is over or it has failed ten times, and prints its line.
fuzz_target() {
    local target=$1 log=$fuzz/findings/$1.log start=$SECONDS before runs=0 left
    mkdir -p "$fuzz/corpus/$target"
    before=$(found "$target")
    : >"$log"
    left=$((60 * minutes))
    while [ "$left" -gt 0 ] && [ "$runs" -lt 10 ]; do
        (cd "$fuzz/findings" && run "$target" "$left") >>"$log" 2>&1 || true
        runs=$((runs + 1))
        left=$((60 * minutes - (SECONDS - start)))
    done
    printf '%-8s %11s executions  %8s hours  %6s edges  %3s findings\n' "$target" \
        "$(executions "$log")" "$(awk -v s=$((SECONDS - start)) 'BEGIN { printf "%.3f", s / 3600 }')" \
        "$(edges "$log")" "$(($(found "$target") - before))"
}

mkdir -p "$fuzz/findings"
if [ $merge = 1 ]; then
    for target in "${targets[@]}"; do
        "$fuzz/tests/fuzz/fuzz_$target" -set_cover_merge=1 -use_counters=0 -timeout=30 \
            "$source/corpus/$target" "$fuzz/corpus/$target" >"$fuzz/findings/merge.log" 2>&1 ||
            die "$target: merging failed: $fuzz/findings/merge.log"
        say "$target: $(find "$source/corpus/$target" -type f | wc -l) inputs"
    done
    exit 0
fi

before=$(found '*')
for target in "${targets[@]}"; do
    fuzz_target "$target"
done
if [ "$(found '*')" -gt "$before" ]; then
    say "what failed: build-fuzz/findings"
    exit 1
fi
