# The statistics: every key, with counts that fit each other.
. "$(dirname "$0")/lib.sh"
write_scene a.json

look_at_all() {
  look "$1" "set(s) >= {'solver', 'skip', 'lights', 'shadow', 'size', 'threads', 'isa', 'ms', 'rays', 'levels'}" \
    "set(s['ms']) == {'read', 'field', 'solve', 'lights', 'write', 'total'}" \
    "set(s['rays']) == {'full', 'traced', 'reduction'}" \
    "all(set(l) >= {'level', 'probes', 'directions', 'traced'} for l in s['levels'])" \
    "[l['level'] for l in s['levels']] == list(range(len(s['levels'])))" \
    "s['skip'] == 'off' and s['size'] == [32, 32] and s['isa'] == 'scalar'" \
    "all(v >= 0 for v in s['ms'].values())" \
    "s['ms']['total'] >= s['ms']['read'] + s['ms']['solve'] + s['ms']['write'] - 0.01" \
    "sum(l['traced'] for l in s['levels']) == s['rays']['traced']" \
    "abs(s['rays']['reduction'] - (1 - s['rays']['traced'] / s['rays']['full'])) < 1e-9"
}

# The default. Segments: the lowest levels are traced, those above are put together from them.
expect_done render a.json -o a.pfm --isa scalar --threads 2 --stats h.stats
look_at_all h.stats
look h.stats "s['solver'] == 'holographic' and s['merge'] is None and s['threads'] == 2"
look h.stats "s['storage'] == 'float' and s['resolution'] == 'full'"
look h.stats "len(s['levels']) == 5 and s['levels'][0]['probes'] == 2 * 32 * 32 and s['memory_bytes'] > 0"
look h.stats "all(l['traced'] > 0 for l in s['levels'][:4]) and all(l['traced'] == 0 for l in s['levels'][4:])"
expect_done render a.json -o half.pfm --isa scalar --storage half --stats h.stats
look h.stats "s['storage'] == 'half'"

expect_done render a.json -o a.pfm --isa scalar --threads 2 --solver cascades --stats a.stats
look_at_all a.stats
look a.stats "s['solver'] == 'cascades' and s['merge'] == 'bilinear-fix' and s['threads'] == 2"
look a.stats "len(s['levels']) > 1 and s['memory_bytes'] > 0"
look a.stats "s['levels'][0]['probes'] == 1024 and s['levels'][0]['directions'] == 4"

expect_done render a.json -o a.pfm --isa scalar --merge nearest-fix --directions 8 --spacing 2 --levels 3 --stats b.stats
look_at_all b.stats
look b.stats "s['merge'] == 'nearest-fix' and len(s['levels']) == 3"
look b.stats "[l['directions'] for l in s['levels']] == [8, 32, 128] and s['levels'][0]['probes'] == 256"

expect_done render a.json -o a.pfm --isa scalar --solver reference --directions 64 --stats c.stats
look_at_all c.stats
look c.stats "s['solver'] == 'reference' and s['merge'] is None and len(s['levels']) == 1"
look c.stats "s['levels'][0]['directions'] == 64 and 0 < s['rays']['traced'] <= 32 * 32 * 64"

# On standard output, and in place of an older file.
expect_done render a.json -o a.pfm --isa scalar --stats -
cp .stdout d.stats
look_at_all d.stats
expect_done render a.json -o a.pfm --isa scalar --solver reference --directions 8 --stats d.stats
look d.stats "s['solver'] == 'reference'"

# Ray skipping: fewer rays, counted; what auto saw and chose.
expect_done render a.json -o a.pfm --skip custom --skip-start 0 --skip-bits 1 --merge bilinear --stats e.stats
look e.stats "s['skip'] == 'custom' and abs(s['rays']['reduction'] - 0.5) < 1e-9 and s['signals'] is None"
for profile in default paper; do
  expect_done render a.json -o a.pfm --skip auto --profile $profile --stats f.stats
  look f.stats "s['skip'] == 'auto' and s['signals']['chosen'] in ('L5', 'L4', 'L3')"
  look f.stats "s['signals']['score'] > 0 and s['signals']['rays'] > 0 and s['rays']['traced'] <= s['rays']['full']"
done
expect_done render a.json -o a.pfm --skip auto --skip-low 1e-9 --skip-high 2e-9 --skip-probes 4 --stats f.stats
look f.stats "s['signals']['chosen'] == 'L3'"

# Exact and bounded: what is proved, and what is guessed and checked.
expect_done render a.json -o off.pfm --solver cascades --skip off
expect_done render a.json -o exact.pfm --skip exact --stats g.stats
look g.stats "s['skip'] == 'exact' and 0 < s['rays']['reduction'] <= 1 and s['guesses'] is None"
check "exact is off, bit for bit" cmp off.pfm exact.pfm
expect_done render a.json -o a.pfm --skip bounded --bound 40 --skip-seed 3 --stats g.stats
look g.stats "s['skip'] == 'bounded' and set(s['guesses']) == {'rays', 'checked', 'wrong'}"

# Rays of the first schedule line are those that are counted when nothing is skipped.
expect_done info --schedule 32x32 --json
cp .stdout schedule.json
look schedule.json "s['rays'] == json.load(open('a.stats'))['rays']['full']"

expect_clean a.json a.pfm half.pfm h.stats a.stats b.stats c.stats d.stats e.stats f.stats g.stats off.pfm exact.pfm schedule.json
finish
