#!/usr/bin/env bash
# Every C and C++ file is formatted as .clang-format says. format.sh --fix formats them. Called by test.sh.
set -euo pipefail
cd "$(dirname "$0")/../.."
formatter=$(command -v clang-format-14 || command -v clang-format)
"$formatter" --version | grep -q 'version 14\.' ||
    { echo "format: clang-format 14 is needed; $formatter is another" >&2; exit 1; }
mapfile -t files < <(tools/check/repository.py c h cpp)
[ ${#files[@]} -gt 0 ] || { echo "format: no files found" >&2; exit 1; }
if [ "${1:-}" = --fix ]; then
    exec "$formatter" -i "${files[@]}"
fi
"$formatter" --dry-run -Werror "${files[@]}" ||
    { echo "format: run tools/check/format.sh --fix" >&2; exit 1; }
echo "${#files[@]} files"
