#!/usr/bin/env bash
# Builds the libFuzzer programs and runs each from its corpus: enough to see that they work and that nothing shallow is
# broken. Called by tools/check/test.sh, with a fixed seed and number of inputs so that the same code passes or fails alike
# every time. For a hunt of its own with a new seed: fuzz.sh SECONDS. What is found is left in build/fuzz/found/.
set -euo pipefail
cd "$(dirname "$0")/../.."
. tools/check/quietly.sh
effort=(-seed=1 -runs=200000)
if [ $# -gt 0 ]; then
    effort=(-max_total_time="$1")
fi

quietly cmake --preset fuzz
quietly cmake --build build/fuzz -j "$(nproc)"
mkdir -p build/fuzz/found
passed=0
for program in build/fuzz/test/fuzz/fuzz_*; do
    [ -f "$program" ] && [ -x "$program" ] || continue
    name=$(basename "$program")
    new=$(mktemp -d)
    quietly "$program" "${effort[@]}" -timeout=20 -rss_limit_mb=4096 -verbosity=1 \
        -artifact_prefix=build/fuzz/found/ "$new" "test/fuzz/corpus/${name#fuzz_}"
    echo "$name: nothing found (${effort[*]}), $(find "$new" -type f | wc -l) new inputs"
    rm -rf "$new"
    passed=$((passed + 1))
done
echo "$passed passed, 0 failed"
[ "$passed" -gt 0 ]
