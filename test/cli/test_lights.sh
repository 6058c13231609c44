# dapple render adds the light of a scene's `lights`: each once, on top of what the solver finds.
. "$(dirname "$0")/lib.sh"

walls='{ "box": { "center": [46, 26], "half": [3, 9], "angle": 0.2 } }, { "box": { "center": [20, 52], "half": [7, 2] } }'
lamp='{ "disc": { "center": [56, 8], "radius": 3 }, "emission": [1, 2, 0.5] }'
light='{ "position": [18, 24], "radius": 9, "color": [1, 0.5, 0.25], "intensity": 3 }'
weak='{ "position": [60, 60], "radius": 4 }'
head='"dapple": 1, "size": [64, 64]'
echo "{ $head, \"shapes\": [ $walls ], \"lights\": [ $light ] }" >dark.json
echo "{ $head, \"shapes\": [ $walls, $lamp ], \"lights\": [ $light, $weak ] }" >both.json
echo "{ $head, \"shapes\": [ $walls, $lamp ] }" >lamp.json
echo "{ $head, \"shapes\": [ $walls, { \"disc\": { \"center\": [18, 24], \"radius\": 9 }, \"emission\": [3, 1.5, 0.75] } ] }" >disc.json

# With nothing else that shines: the light itself, once, whatever the solver.
expect_done shadow dark.json -o shadow.pfm
for solver in cascades reference; do
  expect_done render dark.json -o a.pfm --solver $solver --directions 8
  expect_same a.pfm shadow.pfm
done

# The same lamp as a shape that shines, by brute force alone: the same picture, up to the steps of its outline. Twice
# the light, or none, would be an error of 1.
expect_done render disc.json -o disc.pfm --solver reference --directions 1024
for method in exact rays mrma reference; do
  expect_done render dark.json -o a.pfm --solver reference --directions 8 --shadow $method
  expect_done compare a.pfm disc.pfm --json
  cp .stdout compared.json
  look compared.json "s['rel_rmse'] < 0.1"
done

# With other lamps: the sum of both, pixel by pixel.
expect_done render both.json -o both.pfm --stats both.stats
expect_done render both.json -o without.pfm --lights off --stats without.stats
expect_done render lamp.json -o a.pfm
expect_same without.pfm a.pfm
expect_done shadow both.json -o shadow.pfm
cat >sum.py <<'END'
import array
def values(path):
    with open(path, 'rb') as stream:
        head = [stream.readline() for _ in range(3)]
        assert head[0] == b'PF\n' and float(head[2]) < 0
        return array.array('f', stream.read())
both, without, light = (values(p) for p in ('both.pfm', 'without.pfm', 'shadow.pfm'))
assert len(both) == 64 * 64 * 3 and max(light) > 2 and max(without) == 2
assert all(abs(a - b - c) <= 1e-6 * a for a, b, c in zip(both, without, light))
END
check 'lights come on top of the solver' python3 sum.py
look both.stats "s['lights'] == 2 and s['shadow'] == 'exact' and s['ms']['lights'] > 0"
look without.stats "s['lights'] == 0 and s['shadow'] is None and s['ms']['lights'] == 0"

# The same with one thread and with three; in a picture with a margin, places are the picture's.
expect_done render both.json -o a.pfm --threads 1
expect_done render both.json -o b.pfm --threads 3
expect_same a.pfm b.pfm
expect_done render dark.json -o a.pfm
expect_done render dark.json -o b.pfm --margin 5
expect_same a.pfm b.pfm

# Walls with paint reflect lights, in both solvers that bounce; a disc of that emission instead gives as much, but
# for its outline and what it hides.
painted='{ "box": { "center": [32, 4], "half": [32, 4] }, "albedo": 0.9 }, { "box": { "center": [60, 40], "half": [4, 24] }, "albedo": 0.8 }'
small='{ "center": [30, 34], "radius": 6 }'
echo "{ $head, \"shapes\": [ $painted ], \"lights\": [ { \"position\": [30, 34], \"radius\": 6, \"intensity\": 3 } ] }" >light.json
echo "{ $head, \"shapes\": [ $painted, { \"disc\": $small, \"emission\": [3, 3, 3] } ] }" >shape.json
expect_done render light.json -o direct.pfm
for method in 'reference --directions 512' holographic; do
  expect_done render light.json -o lit.pfm --solver $method --bounces 2
  expect_done render shape.json -o disc.pfm --solver reference --directions 512 --bounces 2
  expect_done compare lit.pfm disc.pfm --mask light.json --json
  cp .stdout compared.json
  look compared.json "s['rel_rmse'] < 0.12"
  expect_done compare direct.pfm disc.pfm --mask light.json --json
  cp .stdout compared.json
  look compared.json "s['rel_rmse'] > 0.2"
  for threads in 1 3; do
    expect_done render light.json -o a.pfm --solver $method --bounces 2 --threads $threads
    expect_same a.pfm lit.pfm
  done
  expect_done render light.json -o a.pfm --solver $method --bounces 2 --lights off
  expect_done render light.json -o b.pfm --solver $method --lights off
  expect_same a.pfm b.pfm
done

expect_usage render ".*" render dark.json -o a.pfm --shadow moments
expect_clean dark.json both.json lamp.json disc.json shadow.pfm a.pfm b.pfm disc.pfm both.pfm without.pfm \
  compared.json sum.py both.stats without.stats light.json shape.json direct.pfm lit.pfm
finish
