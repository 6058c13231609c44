# What the world holds beyond the picture: a margin, a sky per direction, light that bounces.
. "$(dirname "$0")/lib.sh"

# differs A B: two pictures that must not be the same.
differs() { check "$1 and $2 differ" test "$(cksum <"$1")" != "$(cksum <"$2")"; }

# A lamp left of the picture, a painted wall inside, black sky.
cat >lamp.json <<'EOF'
{ "dapple": 1, "size": [32, 24], "margin": 12,
  "shapes": [ { "box": { "center": [-6, 12], "half": [2, 3] }, "emission": 2 },
              { "box": { "center": [20, 12], "half": [2, 6] }, "albedo": [0.8, 0.4, 0.2] } ] }
EOF
truth='--solver reference --directions 64'

expect_done render lamp.json -o scene.pfm $truth
expect_done render lamp.json -o same.pfm $truth --margin 12
expect_same scene.pfm same.pfm
expect_done render lamp.json -o without.pfm $truth --margin 0
differs scene.pfm without.pfm
expect_done render lamp.json -o wide.pfm $truth --margin 30
expect_same scene.pfm wide.pfm
expect_done render lamp.json -o cascades.pfm --solver cascades --stats cascades.stats
look cascades.stats "s['size'] == [32, 24] and s['levels'][0]['probes'] == 56 * 48"
expect_done render lamp.json -o holographic.pfm --stats holographic.stats
look holographic.stats "s['size'] == [32, 24] and s['levels'][0]['probes'] == 2 * 56 * 48"

expect_done render lamp.json -o same.pfm $truth --bounces 0
expect_same scene.pfm same.pfm
expect_done render lamp.json -o bounced.pfm $truth --bounces 2 --stats bounced.stats
differs scene.pfm bounced.pfm
look bounced.stats "len(s['levels']) == 2 and s['levels'][1]['probes'] == 2 * (2 * 4 + 2 * 12)"
look bounced.stats "s['levels'][1]['traced'] == 2 * 32 * 32"
expect_done compare scene.pfm bounced.pfm --mask lamp.json

# What does not fit.
printf '{ "dapple": 1, "size": [16384, 1],\n  "margin": 1 }\n' >long.json
expect_failure 'long.json:2:13: margin: makes a world of 16386 x 3 px, more than 16384 a side' \
  render long.json -o a.pfm
printf '{ "dapple": 1, "size": [16384, 1] }\n' >long.json
expect_failure 'with a margin of 1, 16384 x 1 pixels are more than 16384 a side' \
  render long.json -o a.pfm --margin 1

# A sky lit from above: every solver agrees on it with the truth.
cat >sky.json <<'EOF'
{ "dapple": 1, "size": [16, 16], "sky": [[0, 0, 0], [0, 0, 0], [1, 2, 3], [1, 2, 3]] }
EOF
expect_done render sky.json -o sky-truth.pfm $truth
for solver in holographic cascades; do
  expect_done render sky.json -o sky.pfm --solver $solver
  expect_done compare sky.pfm sky-truth.pfm --json
  check "$solver agrees with the truth" grep -Eq '"rel_rmse": ([0-9.]*e-0[5-9]|0[,.]0*)' .stdout
done

finish
