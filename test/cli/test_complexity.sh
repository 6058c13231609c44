# Complexity, small: counts are exact and repeat, exponents are those of the tables, a run that is stopped leaves
# nothing, and what is refused.
. "$(dirname "$0")/lib.sh"

files='complexity.html complexity.gp tracing.csv flood.csv findings.csv paper.csv'
expect_done complexity --quick --out one
expect_stdout '^naive, object tests +1 to 200 objects +1\.000 \(1\.000 \.\. 1\.000\) +exponent +met$'
expect_stdout '^bvh faster than naive +1 to 16 objects '
expect_stdout '^one/complexity.html$'
for file in $files complexity.svg complexity.png; do
  expect_file "one/$file"
done
expect_done complexity --quick --no-plot --threads 3 --seed 0 --out two
expect_no_file two/complexity.svg
check 'no figure in the page' test "$(grep -c '<figure>' two/complexity.html)" = 0
check 'one figure in the page' test "$(grep -c '<figure>' one/complexity.html)" = 1
expect_same one/paper.csv two/paper.csv

# Everything but the times is the same for every number of threads.
for name in one two; do
  cut -d, -f1-6 "$name/tracing.csv" >"$name.counts"
  cut -d, -f1-5 "$name/flood.csv" >>"$name.counts"
done
expect_same one.counts two.counts
expect_done complexity --quick --no-plot --seed 5 --largest 20 --largest-cells 64 --out three
check 'another seed, other objects' test "$(grep '^growth,bvh,20,10000' three/tracing.csv | cut -d, -f5)" != \
  "$(grep '^growth,bvh,20,10000' one/tracing.csv | cut -d, -f5)"

check 'counts are what the methods must do, and the paper is as printed' python3 - <<'END'
import csv, math
rows = list(csv.DictReader(open("one/tracing.csv")))
for r in rows:
    n, rays = int(r["objects"]), int(r["rays"])
    assert float(r["cpu_ms_min"]) <= float(r["cpu_ms_median"]) <= float(r["cpu_ms_max"]), r
    if r["method"] == "naive":
        assert int(r["object_tests"]) == n * rays and r["node_visits"] == "0", r
    else:
        assert int(r["object_tests"]) <= n * rays and int(r["node_visits"]) >= rays, r
assert {int(r["rays"]) for r in rows if r["part"] == "growth"} == {100, 300, 1000, 3000, 10000}
for r in csv.DictReader(open("one/flood.csv")):
    assert int(r["visits"]) == int(r["cells"]) == int(r["width"]) ** 2, r
for r in csv.DictReader(open("one/paper.csv")):
    n = int(r["objects"])
    assert int(r["naive"]) == 120 * n * n and int(r["flood"]) == 10000
    assert abs(float(r["optimized"]) - 100 * math.log2(n)) < 1e-4
# One fit by hand: node visits of a ray over the logarithm of the objects.
found = {(f["what"], f["over"]): f for f in csv.DictReader(open("one/findings.csv"))}
visits = found["bvh, node visits per ray", "objects"]
points = [(math.log10(int(r["objects"])), int(r["node_visits"]) / int(r["rays"])) for r in rows
          if r["part"] == "growth" and r["method"] == "bvh" and r["rays"] == "10000" and int(r["objects"]) >= 10]
mx, my = (sum(p[i] for p in points) / len(points) for i in (0, 1))
slope = sum((x - mx) * (y - my) for x, y in points) / sum((x - mx) ** 2 for x, _ in points)
assert abs(float(visits["value"]) - slope) < 1e-4, (visits, slope)
assert float(visits["low"]) < slope < float(visits["high"])
END

# Stopped: no files.
last='complexity, then INT'
timeout --preserve-status -s INT 0.7 "$dapple" complexity --largest 20000 --out stopped >.stdout 2>.stderr
status=$?
expect_status 130
expect_stderr 'dapple: stopped: stopped; nothing was written'
check 'no partial files' test -z "$(ls -A stopped 2>/dev/null)"

# Without gnuplot: a note, and a page without a figure.
PATH=/nowhere run complexity --quick --largest 10 --largest-cells 64 --out plain
expect_status 0
expect_stderr 'dapple: note: gnuplot is not there: the page has no figure'
expect_no_file plain/complexity.svg

# Refused.
expect_usage complexity '--out is missing' complexity
expect_usage complexity '--out is missing' complexity --out ''
expect_usage complexity '--largest needs .*' complexity --largest 0 --out one
expect_usage complexity '--largest-cells needs .*' complexity --largest-cells 63 --out one
expect_usage complexity '--threads needs .*' complexity --threads 0 --out one
expect_usage complexity "unexpected argument 'scene'" complexity scene --out one
expect_failure 'one/flood.csv: Not a directory' complexity --quick --out one/flood.csv
mkdir -p taken/tracing.csv
expect_failure 'taken/tracing.csv: .*' complexity --quick --largest 10 --largest-cells 64 --out taken

finish
