#!/usr/bin/env bash
# Builds this folder's project with find_package(dapple) and runs it, with every link flavour. Called by
# tools/check/install.sh: with_cmake.sh PREFIX
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
. "$here/../../../tools/check/quietly.sh"
build=$(mktemp -d)
trap 'rm -rf "$build"' EXIT
quietly cmake -S "$here" -B "$build" -G Ninja -DCMAKE_PREFIX_PATH="$1"
quietly cmake --build "$build"
ctest --test-dir "$build" --output-on-failure --no-tests=error
