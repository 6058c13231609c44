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

# Numbers of the stats file, by the way they are written there: "name": number.
number_of() {
    grep -o "\"$1\": *[0-9.eE+-]*" out/demo.json | head -n 1 | sed 's/.*: *//'
}
total=$(number_of total)
solve=$(number_of solve)
full=$(number_of full)
traced=$(number_of traced)
if [ -z "$total" ] || [ -z "$solve" ] || [ -z "$full" ] || [ -z "$traced" ]; then
    echo "demo: out/demo.json lacks ms.total, ms.solve, rays.full or rays.traced" >&2
    exit 1
fi
echo "Picture: out/demo.png"
echo "Cost:    $total ms in all, $solve ms of it solving; $traced rays traced of $full (out/demo.json)"
