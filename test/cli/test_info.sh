# What info tells, and the schedule that it prints.
. "$(dirname "$0")/lib.sh"

expect_done info
for row in 'version +dapple [0-9.]+' 'build +.+' 'machine +.+' 'isa +[a-z0-9]+ \(usable: scalar.*\)' 'threads +[0-9]+ .*' \
  'exr +(yes|no)' 'solvers +holographic cascades reference'; do
  expect_stdout "^$row\$"
done
expect_done info --json
check 'every key' python3 -c "
import json
s = json.load(open('.stdout'))
assert set(s) >= {'version', 'build', 'machine', 'isa', 'isas', 'threads', 'exr', 'solvers'}
assert 'scalar' in s['isas'] and s['isa'] in s['isas'] and 1 <= s['threads'] <= 64
assert s['solvers'] == ['holographic', 'cascades', 'reference'] and s['exr'] in (True, False)"

expect_done info --schedule 512x512
expect_text schedule-512x512.txt
expect_done info --schedule 1920x1080 --merge bilinear --spacing 2 --directions 8 --interval 1.5 --levels 4
expect_text schedule-1920x1080.txt
expect_done info --schedule 1x1
expect_text schedule-1x1.txt
expect_done info --schedule 16384x16384 --merge nearest-fix
expect_text schedule-16384x16384.txt
for file in "$expected"/schedule-*.txt; do
  check "${file##*/}: columns are aligned" awk 'NR > 2 { if (width && length != width) exit 1; width = length }' "$file"
done

expect_done info --schedule 512x512 --json
expect_text schedule-512x512.json
check 'the totals are sums' python3 -c "
import json
s = json.load(open('.stdout'))
assert s['size'] == [512, 512] and s['merge'] == 'bilinear-fix'
assert s['rays'] == sum(l['rays'] for l in s['levels'])
assert s['bytes'] == sum(l['bytes'] for l in s['levels'])"

finish
