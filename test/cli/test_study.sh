# The paper's study, small: the same bytes however it is run, goes on where it was stopped, and its numbers are
# those of render and compare.
. "$(dirname "$0")/lib.sh"

small='--seeds 2 --first-seed 7 --scenes 2 --size 64 --truth 50'

# same_results A B: every file is the same but the times and the journal, which holds times too.
same_results() {
  check "$1 and $2 hold the same results" diff -r -x 'times.*' -x journal.csv "$1" "$2"
}

expect_done study $small --threads 1 --out one
expect_stdout '^paper +reproduced [0-9]+, partly [0-9]+, not [0-9]+$'
expect_stdout '^corrected +reproduced [0-9]+, partly [0-9]+, not [0-9]+$'
expect_stdout '^one/report.html$'
for file in report.html results.csv signals.csv summary.csv correlations.csv headlines.csv \
  headlines-vs-truth.csv below-50-db.csv times.csv times.md journal.csv plots.gp \
  psnr-paper.svg psnr-corrected.png score.svg reduction.png; do
  expect_file "one/$file"
done
check 'two profiles of six modes, four scenes' test "$(wc -l <one/results.csv)" = 49
check 'a line for each scene' test "$(wc -l <one/journal.csv)" = 6

expect_done study $small --threads 5 --out two
same_results one two

# Going on: behind a whole line, in the middle of one, in the middle of the head.
for keep in "$(head -n 3 two/journal.csv | wc -c)" "$(($(head -n 5 two/journal.csv | wc -c) - 1))" 30; do
  mkdir -p "kept-$keep"
  head -c "$keep" two/journal.csv >"kept-$keep/journal.csv"
  expect_done study $small --threads 2 --out "kept-$keep"
  same_results one "kept-$keep"
  check 'the journal is whole again' test "$(wc -l <"kept-$keep/journal.csv")" = 6
done
check 'finished scenes are not run again' cmp <(sed -n 3p two/journal.csv) \
  <(sed -n 3p "kept-$(head -n 3 two/journal.csv | wc -c)/journal.csv")
expect_done study $small --out two
same_results one two

# Stopped by a signal: says how to go on, and does.
last='study, then INT'
timeout --preserve-status -s INT 1 "$dapple" study --seeds 1 --size 1024 --truth 16384 --out stopped \
  >.stdout 2>.stderr
status=$?
expect_status 130
expect_stderr 'dapple: stopped: stopped after [0-9]+ of 50 scenes; the same command goes on from there'
check 'no results yet' test ! -e stopped/report.html
check 'no bar in a pipe' test ! -s .stdout

# Other arguments, a journal that is not one, folders that cannot be written.
expect_failure "one/journal.csv: belongs to a study with other arguments .*--scenes 2.*--scenes 3.*" \
  study --seeds 2 --first-seed 7 --scenes 3 --size 64 --truth 50 --out one
mkdir broken
sed '1s/build [0-9a-f]*/build 0123456789abcdef/' one/journal.csv >broken/journal.csv
expect_failure 'broken/journal.csv: belongs to a study with other arguments or of another build .*0123456789abcdef.*' \
  study $small --out broken
{ head -n 3 one/journal.csv; echo 1,2,3; } >broken/journal.csv
expect_failure 'broken/journal.csv:4: not a line of this study: mend or remove the file' \
  study $small --out broken
{ head -n 2 one/journal.csv; sed -n 4p one/journal.csv; } >broken/journal.csv
expect_failure 'broken/journal.csv:3: not a line of this study: .*' study $small --out broken
expect_failure 'one/report.html: Not a directory' study $small --out one/report.html
mkdir -p occupied/journal.csv
expect_failure 'occupied/journal.csv: .*' study $small --out occupied
mkdir -p taken/results.csv
expect_failure 'taken/results.csv: .*' study $small --out taken

# One folder, one study: the second is turned away.
python3 - "$dapple" $small >.second <<'END'
import fcntl, subprocess, sys, os
os.makedirs("locked")
with open("locked/journal.csv", "w") as journal:
    fcntl.lockf(journal, fcntl.LOCK_EX)
    second = subprocess.run([sys.argv[1], "study", *sys.argv[2:], "--out", "locked"], capture_output=True, text=True)
    print(second.returncode, second.stderr, end="")
END
check 'a second study is turned away' grep -qx '1 dapple: locked/journal.csv: another study is at work in this folder' .second

# Without gnuplot: a note, and a report without plots.
PATH=/nowhere run study $small --out plain
expect_status 0
expect_stderr 'dapple: note: gnuplot is not there: the report has no plots'
check 'no plots' test ! -e plain/score.svg
check 'no figures in the report' test "$(grep -c '<figure>' plain/report.html)" = 0
expect_same plain/results.csv one/results.csv

# The report: complete, balanced, and needing nothing else.
for heading in 'Skip patterns' 'Fixed modes' 'Adaptive mode' 'Scenes that auto leaves at or below 50 dB' \
  'Correlation of signals with quality' 'What the paper does not report' 'Against the truth' 'Plots' \
  'How to read this'; do
  check "the report has: $heading" grep -q "<h2>$heading</h2>" one/report.html
done
check 'columns beside each other' grep -q "The paper</th><th scope=\"col\">Ours, paper's profile</th><th scope=\"col\">Ours, corrected profile" one/report.html
check 'four plots' test "$(grep -c '<figure>' one/report.html)" = 4
check 'L4 does not save 17 %' python3 -c '
import re
page = open("one/report.html").read().replace("\u00a0", " ")
row = re.search(r"<tr><th scope=\"row\">L4, ray reduction.*?</tr>", page, re.S).group(0)
assert "<td>~17 %</td>" in row and row.count("<td>20.0 %<span class=\"v not\">not reproduced</span></td>") == 2, row'
check 'well-formed and self-contained' python3 - <<'END'
from html.parser import HTMLParser
class Balanced(HTMLParser):
    def __init__(self):
        super().__init__()
        self.open, self.ids = [], []
    def handle_starttag(self, tag, attributes):
        names = dict(attributes)
        self.ids += [names["id"]] if "id" in names else []
        for name in ("src", "href", "xlink:href"):
            assert names.get(name, "#").startswith("#"), names
        assert tag not in ("script", "link", "img"), tag
        if tag != "meta":
            self.open.append(tag)
    def handle_endtag(self, tag):
        assert self.open.pop() == tag, (tag, self.getpos())
page = Balanced()
page.feed(open("one/report.html").read())
assert not page.open and len(page.ids) == len(set(page.ids))
END

# The summary follows from the results; vs off and vs truth have columns of their own.
check 'the statistics are those of the results' python3 - <<'END'
import csv, math, statistics
rows = list(csv.DictReader(open("one/results.csv")))
signals = list(csv.DictReader(open("one/signals.csv")))
def close(text, value, unit):
    assert abs(float(text) - value) <= unit, (text, value)
for row in rows:
    close(row["reduction"], 1 - int(row["rays_traced"]) / int(row["rays_full"]), 1e-6)
    assert row["same_picture_dead_dropped"] == ("1" if row["profile"] == "paper" else ""), row
    assert (row["mode"] == "off") == (row["psnr_display_vs_off"] == ""), row
    assert row["mode"] == "auto" or row["mode"] == row["used_mode"], row
    if row["profile"] == "paper":
        assert int(row["rays_traced_dead_dropped"]) <= int(row["rays_traced"]), row
expected = {"off": 0, "L5": 0.1, "L4": 0.2, "L3": 0.25, "L2": 0.4}
for s in csv.DictReader(open("one/summary.csv")):
    mine = [r for r in rows if s["seed"] in ("all", r["seed"]) and r["profile"] == s["profile"] and r["mode"] == s["mode"]]
    assert int(s["scenes"]) == len(mine) == (4 if s["seed"] == "all" else 2)
    if s["mode"] in expected:
        close(s["reduction"], expected[s["mode"]], 1e-6)
    else:
        choices = [sum(r["used_mode"] == m for r in mine) for m in ("L5", "L4", "L3")]
        assert choices == [int(s["auto_chose_" + m]) for m in ("L5", "L4", "L3")]
        close(s["reduction_hard_coded"], sum(c * x for c, x in zip(choices, (.1, .17, .25))) / len(mine), 1e-6)
    for column in ("psnr_display_vs_off", "psnr_linear_vs_off", "psnr_display_vs_truth", "psnr_linear_vs_truth", "rel_rmse_vs_truth"):
        if s["mode"] == "off" and column.endswith("vs_off"):
            assert s[column + "_mean"] == ""
            continue
        values = [float(r[column]) for r in mine]
        finite = [v for v in values if math.isfinite(v)]
        assert int(s[column + "_infinite"]) == len(values) - len(finite)
        close(s[column + "_mean"], statistics.mean(finite), 2e-4)
        close(s[column + "_min"], min(finite), 1e-6)
        close(s[column + "_max"], max(finite), 1e-6)
def pearson(x, y):
    mx, my = statistics.mean(x), statistics.mean(y)
    return sum((a - mx) * (b - my) for a, b in zip(x, y)) / math.sqrt(sum((a - mx) ** 2 for a in x) * sum((b - my) ** 2 for b in y))
for c in csv.DictReader(open("one/correlations.csv")):
    if c["signal"] != "bandwidth90" or c["seed"] != "all":
        continue
    x = [float(s["bandwidth90"]) for s in signals if s["profile"] == c["profile"]]
    y = [float(r[c["with_L2_mode"]]) for r in rows if r["profile"] == c["profile"] and r["mode"] == "L2"]
    close(c["r"], pearson(x, y), 1e-4)
below = [r for r in rows if r["mode"] == "auto" and float(r["psnr_display_vs_off"]) <= 50]
assert len(below) == len(list(csv.DictReader(open("one/below-50-db.csv"))))
END

# One scene by the other commands: the same PSNR.
expect_done scenes arc --seed 7 --size 64 --out scenes
paper='--profile paper'
corrected='--merge bilinear --spacing 2 --directions 16 --levels 5 --interval 0.353904'
for profile in paper corrected; do
  for mode in off L2 auto; do
    expect_done render scenes/arc-01.json -o "$profile-$mode.pfm" ${!profile} --skip "$mode"
  done
  for mode in L2 auto; do
    expect_done compare "$profile-$mode.pfm" "$profile-off.pfm" --json
    check "$profile $mode: psnr_display as compare says" python3 -c '
import csv, json, sys
row = [r for r in csv.DictReader(open("one/results.csv")) if r["seed"] == "7" and r["scene"] == "1"
       and [r["profile"], r["mode"]] == sys.argv[1:]][0]
assert abs(json.load(open(".stdout"))["psnr_display"] - float(row["psnr_display_vs_off"])) < 1e-4, row' "$profile" "$mode"
  done
done

# Wrong usage.
expect_usage study '--seeds is missing' study --out one
expect_usage study '--out is missing' study --seeds 1
expect_usage study '--seeds needs .*' study --seeds 0 --out one
expect_usage study '--scenes needs .*' study --seeds 1 --scenes 51 --out one
expect_usage study '--size needs .*' study --seeds 1 --size 32 --out one
expect_usage study '--truth needs .*' study --seeds 1 --truth 0 --out one
expect_usage study "unexpected argument 'arc'" study arc --seeds 1 --out one
expect_usage study 'there are no 2 seeds from --first-seed on' \
  study --seeds 2 --first-seed 18446744073709551615 --out one

finish
