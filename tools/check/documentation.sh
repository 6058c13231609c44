#!/usr/bin/env bash
# Every public name has a doc comment and every comment fits what it describes. Called by tools/check/test.sh.
set -euo pipefail
cd "$(dirname "$0")/../.."
DPL_DOXYGEN_OUTPUT=$(mktemp -d)
export DPL_DOXYGEN_OUTPUT
trap 'rm -rf "$DPL_DOXYGEN_OUTPUT"' EXIT
doxygen tools/check/Doxyfile
# What doxygen made of it, so that an empty input cannot pass for a documented one.
functions=$(cat "$DPL_DOXYGEN_OUTPUT"/xml/*.xml | grep -c '<memberdef kind="function"' || true)
[ "$functions" -gt 0 ] || { echo "documentation: doxygen found no public functions" >&2; exit 1; }
echo "$functions public functions, nothing undocumented"
