# Flood fill: writes what it is asked for, counts, and refuses what makes no sense.
. "$(dirname "$0")/lib.sh"
write_scene a.json

expect_done flood a.json -o a.png --falloff euclidean
expect_done flood a.json -o a.pfm --falloff subtractive --range 40 --sun --stats a.stats
expect_done flood a.json -o b.pfm --falloff subtractive --range 40 --sun
expect_same a.pfm b.pfm
look a.stats "s['solver'] == 'flood' and s['falloff'] == 'subtractive' and s['range'] == 40" \
  "s['size'] == [32, 32] and s['lights'] == 32" \
  "set(s['ms']) == {'read', 'field', 'solve', 'write', 'total'}" \
  "s['visits'] > 500 and s['pushes'] >= s['visits'] / 2 and s['memory_bytes'] > 0"
expect_done flood a.json -o c.pfm
check "the falloffs differ" sh -c '! cmp -s b.pfm c.pfm'

# The lamp shows its own radiance, and nothing is brighter.
check "the lamp is as bright as it emits" python3 -c '
import struct
data = open("c.pfm", "rb").read()
values = struct.unpack("<3072f", data[-12288:])
assert abs(max(values) - 2.0) < 1e-6, max(values)'

expect_usage flood "-o OUT is missing" flood a.json
expect_usage flood ".*range.*" flood a.json -o d.png --range 0
expect_usage flood ".*falloff.*" flood a.json -o d.png --falloff square
expect_failure ".*no.json.*" flood no.json -o d.png
expect_clean a.json a.png a.pfm a.stats b.pfm c.pfm
finish
