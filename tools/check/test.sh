#!/usr/bin/env bash
# Every check there is, a stage at a time; stops at the first that fails. Called by make test, by .ci/run and,
# as FAST=1 make test, by people in a hurry.
set -euo pipefail
cd "$(dirname "$0")/../.."
export LC_ALL=C.UTF-8
fast=${FAST:-0}
passed=0
times=

# stage NAME COMMAND…
stage() {
    local name=$1 begin=$SECONDS status=0
    shift
    printf '\n=== %s\n' "$name"
    "$@" 2>&1 || status=$?
    local took=$((SECONDS - begin))
    if [ "$status" -ne 0 ]; then
        printf '=== FAILED after %d s: %s (%d stages before it passed). Again: %s\n' \
            "$took" "$name" "$passed" "$*"
        exit 1
    fi
    printf '=== passed in %d s: %s\n' "$took" "$name"
    passed=$((passed + 1))
    times+=$(printf '%5d s  %s' "$took" "$name")$'\n'
}

check=tools/check
stage "format" $check/format.sh
stage "layering checks itself" $check/layering.py --self-test
stage "layering" $check/layering.py
stage "house rules" $check/house.py
stage "public headers alone" $check/headers.sh
if [ "$fast" != 1 ]; then
    stage "public names documented" $check/documentation.sh
fi
stage "gcc release: build and tests" $check/build.sh release
if [ "$fast" != 1 ]; then
    stage "exported symbols" $check/symbols.py build/release/src
    stage "instruction counts" $check/instructions.py
    stage "web: the WebAssembly build, and tests in node and Chromium" $check/web.sh
    stage "clang: build and tests" $check/build.sh clang
    stage "address and undefined behaviour sanitizers: build and tests" $check/build.sh asan rest
    stage "thread sanitizer: build and tests of threaded code" $check/build.sh tsan threaded
    stage "fuzz targets: build, and 200000 inputs each" $check/fuzz.sh
    stage "install, outside projects, example of the README" $check/install.sh
fi

printf '\n%s' "$times"
if [ "$fast" = 1 ]; then
    echo "All $passed stages of FAST=1 passed in $SECONDS s;" \
        "left out: documentation, symbols, instruction counts, web, clang, sanitizers, fuzzing, install"
else
    echo "All $passed stages passed in $SECONDS s"
fi
