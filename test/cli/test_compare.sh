# Comparing: equal pictures, different ones, masks, and pairs that do not go together.
. "$(dirname "$0")/lib.sh"
write_scene a.json
write_scene small.json 16
expect_done render a.json -o a.pfm
expect_done render a.json -o a.png
expect_done render a.json -o truth.pfm --solver reference --directions 256
expect_done render a.json -o truth.png --solver reference --directions 256
expect_done render small.json -o small.pfm

keys="set(s) == {'psnr_linear', 'psnr_display', 'rel_rmse', 'ssim', 'flip', 'pixels', 'identical'}"

for same in a.pfm a.png; do
  expect_done compare $same $same --json
  look .stdout "$keys"
  look .stdout "s['psnr_linear'] is None and s['psnr_display'] is None and s['identical'] is True"
  look .stdout "s['rel_rmse'] == 0 and abs(s['ssim'] - 1) < 1e-9 and s['flip'] == 0 and s['pixels'] == 1024"
  expect_done compare $same $same
  expect_stdout '^psnr_linear +inf +dB, peak 1$'
  expect_stdout '^identical +yes$'
done

expect_done compare a.pfm truth.pfm --json
look .stdout "$keys"
look .stdout "20 < s['psnr_linear'] < 80 and s['identical'] is False and 0 < s['rel_rmse'] < 0.5"
look .stdout "0.5 < s['ssim'] < 1 and 0 < s['flip'] < 0.5 and s['pixels'] == 1024"
expect_done compare a.pfm truth.pfm
check 'a row for each measure' test "$(wc -l <.stdout)" = 7
expect_done compare a.png truth.png --json
look .stdout "s['identical'] is False and 20 < s['psnr_display'] < 80"

# Opaque pixels are left out.
expect_done compare a.pfm truth.pfm --mask a.json --json
look .stdout "900 < s['pixels'] < 1024"
printf '{ "dapple": 1, "size": [32, 32], "shapes": [ { "box": { "center": [16, 16], "half": [16, 8] } } ] }' >half.json
expect_done compare a.pfm truth.pfm --mask half.json --json
look .stdout "s['pixels'] == 512"
printf '{ "dapple": 1, "size": [32, 32], "shapes": [ { "box": { "center": [16, 16], "half": [16, 16] } } ] }' >all.json
expect_failure '.*' compare a.pfm truth.pfm --mask all.json

# Pairs that do not go together, and files that are no pictures.
expect_failure 'a\.png: is a PNG .*a\.pfm is linear.*' compare a.png a.pfm
expect_failure 'a\.png: is a PNG .*a\.pfm is linear.*' compare a.pfm a.png
expect_failure 'small\.pfm: is 16x16, but a\.pfm is 32x32' compare small.pfm a.pfm
expect_failure 'small\.json: is 16x16, but the pictures are 32x32' compare a.pfm a.pfm --mask small.json
expect_failure 'absent\.pfm: .*' compare absent.pfm a.pfm
expect_failure 'absent\.pfm: .*' compare a.pfm absent.pfm
expect_failure 'absent\.json: .*' compare a.pfm a.pfm --mask absent.json
expect_failure 'a\.json: .*' compare a.json a.pfm
head -c 500 a.pfm >short.pfm
expect_failure 'short\.pfm: .*' compare short.pfm a.pfm

# A full disk.
for form in '' --json; do
  "$dapple" compare a.pfm a.pfm $form >/dev/full 2>.stderr
  status=$?
  last="compare a.pfm a.pfm $form >/dev/full"
  expect_status 1
  expect_stderr 'dapple: standard output: No space left on device'
done

finish
