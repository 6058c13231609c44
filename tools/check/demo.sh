#!/usr/bin/env bash
# Builds the tool, renders the demo scene and says where the picture is and what it cost. Called by make demo.
set -euo pipefail
cd "$(dirname "$0")/../.."
. tools/check/quietly.sh

tool=build/release/tools/dapple/dapple
echo "Building ..."
quietly cmake --preset release
quietly cmake --build build/release -j "$(nproc)" --target tools/dapple/dapple

echo "Rendering the demo scene ..."
rm -rf out/demo-scene out/demo.png out/demo.json # what is shown is what was made now
mkdir -p out
quietly "$tool" scenes demo --seed 1 --out out/demo-scene
"$tool" render out/demo-scene/demo-00.json -o out/demo.png --stats out/demo.json
if [ ! -s out/demo.png ]; then
    echo "demo: the tool reported success but wrote no out/demo.png" >&2
    exit 1
fi

# number_of OBJECT NAME: a number of the stats file, whatever its order and layout.
number_of() {
    tr -d '[:space:]' <out/demo.json | grep -o "\"$1\":{[^{}]*}" | grep -o "\"$2\":[0-9.eE+-]*" | sed 's/.*://'
}
cost=()
for name in "ms total" "ms solve" "rays traced" "rays full"; do
    # Word splitting is wanted: object and name.
    # shellcheck disable=SC2086
    cost+=("$(number_of $name)") || { echo "demo: out/demo.json lacks $name" >&2; exit 1; }
done
echo "Picture: out/demo.png"
echo "Cost:    ${cost[0]} ms in all, ${cost[1]} ms of it solving; ${cost[2]} segments traced where there" \
    "are ${cost[3]} (out/demo.json)"
