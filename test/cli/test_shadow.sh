# dapple shadow: pictures of light and of visibility, statistics, the comparison, and what is refused.
. "$(dirname "$0")/lib.sh"

cat >a.json <<'END'
{ "dapple": 1, "size": [48, 32],
  "shapes": [ { "box": { "center": [24, 16], "half": [2, 6] } } ],
  "lights": [ { "position": [8, 16], "radius": 3, "color": [1, 0.5, 0.2], "intensity": 2 },
              { "position": [40, 5], "radius": 2 } ] }
END
write_scene dark.json

# Each kind of output; each method; methods with more than one name.
for out in a.png a.pfm; do
  expect_done shadow a.json -o $out
  expect_file $out
done
expect_done shadow a.json -o -
check 'PFM on standard output' test "$(head -c 2 .stdout)" = PF
for method in exact reference moments-2 moments-evsm moments-4 moments-soft pcss distance-hard distance-quilez \
  distance-aaltonen distance-signed distance-two-sided distance-cones mrma rays; do
  expect_done shadow a.json -o "$method.pfm" --method "$method" --light 1
  expect_file "$method.pfm"
done
expect_done shadow a.json -o b.pfm --method moments --light 1
expect_same b.pfm moments-soft.pfm
expect_done shadow a.json -o b.pfm --method distance --light 1
expect_same b.pfm distance-cones.pfm
for weight in smooth-min min constant distance gap variance literal; do
  expect_done shadow a.json -o b.pfm --method mrma --weight "$weight" --field distance-signed --map pcss
done
expect_done shadow a.json -o b.png --light 0

# The same for every number of threads, and close to the reference.
expect_done shadow a.json -o one.pfm --threads 1
expect_done shadow a.json -o three.pfm --threads 3
expect_same one.pfm three.pfm
expect_done shadow a.json -o truth.pfm --method reference --samples 2048
expect_done compare one.pfm truth.pfm --json
cp .stdout compared.json
look compared.json "s['rel_rmse'] < 2e-3"

# Statistics.
expect_done shadow a.json -o b.pfm --stats a.stats
look a.stats "set(s) == {'method', 'weight', 'light', 'lights', 'size', 'threads', 'ms', 'pixels', 'steps', 'fetches', 'memory_bytes'}" \
  "set(s['ms']) == {'read', 'field', 'map', 'solve', 'write', 'total'}" \
  "s['method'] == 'exact' and s['weight'] is None and s['light'] is None and s['lights'] == 2 and s['size'] == [48, 32]" \
  "s['pixels']['all'] == s['pixels']['lit'] + s['pixels']['dark'] + s['pixels']['worked'] == 2 * (48 * 32 - 4 * 12)"
expect_done shadow a.json -o b.pfm --method mrma --light 1 --stats -
cp .stdout a.stats
look a.stats "s['method'] == 'mrma' and s['weight'] == 'smooth-min' and s['light'] == 1 and s['lights'] == 1"

# The comparison: a row per method and weight, a sheet.
expect_done shadow a.json -o sheet.png --compare all --samples 512 --stats b.stats
expect_file sheet.png
expect_stdout '^method +rmse +penumbra'
expect_stdout '^exact +0\.00'
look b.stats "len(s['methods']) == 21" \
  "[m for m in s['methods'] if m['method'] == 'exact'][0]['rmse'] < 0.002" \
  "all(m['ms'] >= 0 and m['fetches_per_pixel'] >= 0 for m in s['methods'])"

# Refused.
rm -f b.pfm
expect_failure "dark.json: the scene has no .lights." shadow dark.json -o b.pfm
expect_failure "a.json: there is no light 2: the scene has lights 0 to 1" shadow a.json -o b.pfm --light 2
expect_usage shadow "-o OUT is missing" shadow a.json
expect_usage shadow ".*--method mrma" shadow a.json -o b.pfm --tau 0.1
expect_usage shadow "--map-resolution must be a multiple of 4" shadow a.json -o b.pfm --map-resolution 1002
expect_usage shadow "--compare writes a sheet.*" shadow a.json -o b.pfm --compare all
expect_usage shadow "'a.json' is the scene and the output|.*" shadow a.json -o a.json
expect_usage shadow ".*" shadow a.json -o b.pfm --method nonsense
expect_failure ".*" shadow missing.json -o b.pfm
expect_failure ".*" shadow a.json -o no/folder/b.pfm
expect_no_file b.pfm
finish
