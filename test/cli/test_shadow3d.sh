# Shadows in space: methods agree as they should, one light alone, statistics, and what is refused.
. "$(dirname "$0")/lib.sh"
cat >a.json <<'JSON'
{ "dapple3d": 1, "size": [60, 40], "ambient": 0.1,
  "camera": { "eye": [2, 2, 3], "target": [0, 0.3, 0] },
  "lights": [
    { "spot": { "position": [1, 4, 1], "direction": [-1, -4, -1], "radius": 0.2 }, "intensity": 20 },
    { "directional": { "direction": [1, -2, 0], "radius": 0.05 }, "color": [0.2, 0.3, 0.5] } ],
  "meshes": [
    { "plane": { "half": [3, 1, 3] }, "casts": 0 },
    { "sphere": { "center": [0, 0.5, 0], "radius": 0.4 }, "albedo": [0.8, 0.2, 0.1] },
    { "box": { "half": [0.3, 0.02, 0.3] }, "rotate": [0, 0.4, 0], "move": [0.8, 0.6, 0.5] } ] }
JSON
expect_done shadow3d a.json -o a.pfm --stats a.stats --threads 2
expect_done shadow3d a.json -o b.pfm --threads 1
check "threads do not show" cmp a.pfm b.pfm
look a.stats "s['method'] == 'mrma' and s['size'] == [60, 40] and len(s['lights']) == 2 and s['mesh']['closed'] == 2"
look a.stats "all(l['receivers'] == 2400 and l['refined'] > 0 and l['rays'] == 32 * l['refined'] for l in s['lights'])"
expect_done shadow3d a.json -o truth.pfm --method reference
expect_done compare a.pfm truth.pfm --json
cp .stdout compared.json
look compared.json "s['psnr_linear'] > 35"
expect_done shadow3d a.json -o one.pfm --light 1
expect_done shadow a.json -o same.pfm --light 1
check "shadow hands a scene in space on" cmp one.pfm same.pfm
expect_done shadow3d a.json -o a.png --method moments --map 256
expect_done shadow3d a.json -o c.png --method march --field 48 --cones 4
expect_file a.png

sed 's/"radius": 0.4 }/"radios": 0.4 }/' a.json >bad.json
run shadow3d bad.json -o out.pfm
expect_status 1
expect_stderr 'dapple: bad.json:8:42: meshes\[1\].sphere.radios: unknown key; allowed here: center, radius, rings'
expect_no_file out.pfm
run shadow3d a.json -o out.pfm --light 2
expect_status 1
expect_stderr 'dapple: a.json: has 2 lights, and no light 2'
run shadow3d a.json -o out.pfm --map 255
expect_status 2
run shadow3d a.json -o out.pfm --cones 2
expect_status 2
run shadow3d a.json
expect_status 2
run shadow3d missing.json -o out.pfm
expect_status 1
expect_no_file out.pfm

expect_clean a.json bad.json a.pfm b.pfm truth.pfm one.pfm same.pfm a.stats compared.json a.png c.png
finish
