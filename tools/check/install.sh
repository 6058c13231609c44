#!/usr/bin/env bash
# Installs the library alone (no tool, no tests: neither libpng nor jansson is looked for) into a temporary
# folder and uses it from there as strangers would: CMake, pkg-config, the README. Called by tools/check/test.sh.
set -euo pipefail
cd "$(dirname "$0")/../.."
. tools/check/quietly.sh
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
prefix=$work/prefix

quietly cmake -S . -B "$work/build" -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_INSTALL_PREFIX="$prefix" \
    -DDPL_WERROR=ON -DDPL_TOOLS=OFF -DDPL_TESTS=OFF -DDPL_BENCH=OFF
quietly cmake --build "$work/build" -j "$(nproc)"
quietly cmake --install "$work/build"

strangers=$(find "$prefix/include" -type f ! -path "$prefix/include/dapple/*.h")
if [ -n "$strangers" ]; then
    echo "install: these do not belong into an include folder: $strangers" >&2
    exit 1
fi

test/api/outside/with_cmake.sh "$prefix"
test/api/outside/with_pkg_config.sh "$prefix"
test/api/readme_example.sh "$prefix"
