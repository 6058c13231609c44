#!/usr/bin/env bash
# The first C example of README.md compiles without a warning against an installed Dapple, and runs. Called by
# tools/check/install.sh: readme_example.sh PREFIX
set -euo pipefail
cd "$(dirname "$0")/../.."
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

fail() {
    echo "readme_example: $*" >&2
    exit 1
}

[ -f README.md ] || fail "there is no README.md"
awk '/^```c[[:space:]]*$/ { inside = 1; next } inside && /^```/ { exit } inside' README.md >"$work/example.c"
[ -s "$work/example.c" ] || fail 'README.md has no ```c block, or its first is empty'
grep -q '\<main *(' "$work/example.c" || fail 'the first ```c block of README.md is not a whole program'

config=$(find "$1" -name dapple.pc)
[ -n "$config" ] || fail "no dapple.pc was installed"
export PKG_CONFIG_PATH="${config%/*}"
read -ra flags < <(pkg-config --cflags --libs dapple)
gcc -std=c17 -Wall -Wextra -Werror "$work/example.c" -o "$work/example" "${flags[@]}" ||
    fail 'the first ```c block of README.md does not compile'
# In an empty folder, since an example may write its picture to where it is.
mkdir "$work/run"
(cd "$work/run" && LD_LIBRARY_PATH=$(pkg-config --variable=libdir dapple) timeout 60 "$work/example") ||
    fail "the example of README.md failed with status $?"
echo "the example of README.md compiles and runs"
