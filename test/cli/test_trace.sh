# Tracing scenes of shapes: both methods write the same bytes, close to the reference; what cannot be traced is refused.
. "$(dirname "$0")/lib.sh"
cat >a.json <<'JSON'
{ "dapple": 1, "size": [40, 30], "sky": [0.02, 0.03, 0.05],
  "shapes": [
    { "disc": { "center": [10, 10], "radius": 4 }, "emission": [1, 0.8, 0.5] },
    { "box": { "center": [25, 12], "half": [2, 8], "angle": 0.3 } },
    { "polygon": { "points": [[5, 20], [15, 22], [8, 28]] } },
    { "segment": { "from": [30, 25], "to": [38, 20], "width": 1.5 }, "emission": [0, 0.4, 1] } ] }
JSON
expect_done trace a.json -o bvh.pfm --stats bvh.stats --threads 2
expect_done trace a.json -o naive.pfm --method naive --stats naive.stats
check "both methods write the same bytes" cmp bvh.pfm naive.pfm
look bvh.stats "s['method'] == 'bvh' and s['size'] == [40, 30] and s['rays'] == 40 * 30 * 256 and s['node_visits'] > 0"
look naive.stats "s['object_tests'] == 4 * s['rays'] and s['node_visits'] == 0 and s['shapes'] == 4"
expect_done render a.json -o reference.pfm --solver reference --directions 256
expect_done compare bvh.pfm reference.pfm --mask a.json --json
cp .stdout compared.json
look compared.json "s['psnr_linear'] > 30"
expect_done trace a.json -o bvh.png
expect_file bvh.png

sed 's/"angle": 0.3 }/"angle": 0.3 }, "extinction": 0.05/' a.json >fog.json
run trace fog.json -o fog.pfm
expect_status 1
check "the shape is named" grep -q 'shape 1 is not opaque' .stderr
expect_no_file fog.pfm
run trace a.json -o out.pfm --method slow
expect_status 2
run trace a.json
expect_status 2
run trace missing.json -o out.pfm
expect_status 1
expect_no_file out.pfm

expect_clean a.json fog.json bvh.pfm naive.pfm bvh.stats naive.stats reference.pfm compared.json bvh.png
finish
