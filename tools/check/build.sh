#!/usr/bin/env bash
# Builds one CMake preset (quietly, unless that fails) and runs its tests. Called by tools/check/test.sh:
#   build.sh PRESET            everything
#   build.sh PRESET threaded   only the tests of code that runs on several threads
#   build.sh PRESET rest       all but those of test/determinism/, which are long and among the threaded
set -euo pipefail
cd "$(dirname "$0")/../.."
. tools/check/quietly.sh
preset=$1
which=${2:-all}

# Threaded tests are those of test/determinism/ and any other that sets a thread_count, but for some long ones:
# test_reuse_frames solves the same with two threads.
threaded_tests() {
    { ls test/determinism/test_*.c; grep -l thread_count test/*/test_*.c; } | xargs -n 1 basename -s .c | sort -u |
        grep -vx -e test_reuse -e test_cascades_exact -e test_cascades_bounded
}

targets=() chosen=()
if [ "$which" = threaded ]; then
    mapfile -t names < <(threaded_tests)
    targets=(--target "${names[@]}")
    chosen=(-R "^($(IFS='|' && echo "${names[*]}"))\$")
fi

if [ "$which" = rest ]; then
    mapfile -t names < <(ls test/determinism/test_*.c | xargs -n 1 basename -s .c)
    chosen=(-E "^($(IFS='|' && echo "${names[*]}"))\$")
fi

# The sanitizers of gcc 12 cannot live with the address randomisation of some newer kernels; some containers
# forbid turning it off.
fixed_addresses=()
if setarch -R true 2>/dev/null; then
    fixed_addresses=(setarch -R)
fi

quietly cmake --preset "$preset"
quietly cmake --build "build/$preset" -j "$(nproc)" "${targets[@]}"
"${fixed_addresses[@]}" ctest --preset "$preset" -j "$(nproc)" --timeout 300 --no-tests=error "${chosen[@]}"
