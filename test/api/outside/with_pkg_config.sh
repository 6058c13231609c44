#!/usr/bin/env bash
# Builds this folder's programs with nothing but pkg-config and runs them. Called by tools/check/install.sh:
# with_pkg_config.sh PREFIX
set -euo pipefail
cd "$(dirname "$0")"
build=$(mktemp -d)
trap 'rm -rf "$build"' EXIT
config=$(find "$1" -name dapple.pc)
[ -n "$config" ] || { echo "with_pkg_config: no dapple.pc was installed" >&2; exit 1; }
export PKG_CONFIG_PATH="${config%/*}"
libraries=$(pkg-config --variable=libdir dapple)
read -ra compile < <(pkg-config --cflags dapple)
read -ra link < <(pkg-config --libs dapple)
strict=(-Wall -Wextra -Wpedantic -Werror)

gcc -std=c17 "${strict[@]}" "${compile[@]}" outside.c -o "$build/c" "${link[@]}"
g++ -std=c++17 "${strict[@]}" "${compile[@]}" outside.cpp -o "$build/cpp" "${link[@]}"
for program in c cpp; do
    LD_LIBRARY_PATH=$libraries "$build/$program"
done
read -ra link < <(pkg-config --static --libs dapple)
gcc -std=c17 -static "${strict[@]}" "${compile[@]}" outside.c -o "$build/c_static" "${link[@]}"
"$build/c_static"
