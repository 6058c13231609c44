# What every command line test starts from: runs the tool, keeps what it said, counts what held.
# Sourced by test_*.sh, which get the tool's path as their argument and run in a folder of their own.
set -u
dapple=$1
expected=$(cd "$(dirname "${BASH_SOURCE[0]}")/expected" && pwd)
folder=$(mktemp -d "$PWD/cli-XXXXXX") || exit 1
trap 'rm -rf "$folder"' EXIT
cd "$folder" || exit 1
passed=0
failed=0

pass() { passed=$((passed + 1)); }

# fail WHAT: with the last command and what it said.
fail() {
  failed=$((failed + 1))
  printf 'FAILED: %s\n  after: dapple %s\n  status: %s\n' "$1" "${last:-}" "${status:-}"
  sed 's/^/  stderr: /' .stderr 2>/dev/null
}

# check WHAT COMMAND...: the command must succeed.
check() {
  local what=$1
  shift
  if "$@" >/dev/null 2>.check; then pass; else fail "$what"; sed 's/^/  check: /' .check; fi
}

# run ARGUMENT...: leaves status, .stdout and .stderr.
run() {
  last=$*
  "$dapple" "$@" >.stdout 2>.stderr
  status=$?
}

expect_status() { check "exit status is $1" test "$status" = "$1"; }
expect_file() { check "file $1 is there" test -s "$1"; }
expect_no_file() { check "no file $1" test ! -e "$1"; }
expect_silence() { check "nothing on standard error" test ! -s .stderr; }
expect_stdout() { check "standard output has: $1" grep -Eq -- "$1" .stdout; }

# expect_stderr PATTERN: exactly one line, and it matches the whole extended pattern.
expect_stderr() {
  check "one line on standard error" test "$(wc -l <.stderr)" = 1
  check "standard error is: $1" grep -Exq -- "$1" .stderr
}

# expect_done ARGUMENT...: works and says nothing beside its results.
expect_done() {
  run "$@"
  expect_status 0
  expect_silence
}

# expect_failure PATTERN ARGUMENT...: exit status 1, one line "dapple: PATTERN", no results.
expect_failure() {
  local pattern=$1
  shift
  run "$@"
  expect_status 1
  expect_stderr "dapple: $pattern"
  check "nothing on standard output" test ! -s .stdout
}

# expect_usage COMMAND PATTERN ARGUMENT...: exit status 2, one line that points to the help of COMMAND.
expect_usage() {
  local name="dapple${1:+ $1}" pattern=$2
  shift 2
  run "$@"
  expect_status 2
  expect_stderr "$name: $pattern \\(try '$name --help'\\)"
  check "nothing on standard output" test ! -s .stdout
}

# expect_text NAME: standard output is what expected/NAME holds. UPDATE=1 stores it there instead.
expect_text() {
  if test "${UPDATE:-0}" = 1; then
    cp .stdout "$expected/$1"
  fi
  check "standard output is expected/$1" diff -u "$expected/$1" .stdout
}

# expect_same A B: two files hold the same bytes.
expect_same() { check "$1 and $2 are the same" cmp "$1" "$2"; }

# expect_clean [FILE...]: nothing but the files named (and those of this library) is in the folder.
expect_clean() {
  printf '%s\n' .check .stderr .stdout .wanted .found "$@" | sort >.wanted
  : >.found
  find . -type f -printf '%P\n' | sort >.found
  check "no file left behind: $(comm -13 .wanted .found | tr '\n' ' ')" cmp .wanted .found
}

# look FILE EXPRESSION...: Python expressions that hold for the JSON `s` in a file.
look() {
  local file=$1
  shift
  check "$file holds what it should" python3 -c '
import json, sys
s = json.load(open(sys.argv[1]))
wrong = [text for text in sys.argv[2:] if not eval(text)]
sys.exit("\n".join(["not so: " + text for text in wrong] + [str(s)]) if wrong else 0)' "$file" "$@"
}

# write_scene FILE [SIZE]: a lamp, a wall and a medium.
write_scene() {
  local size=${2:-32}
  cat >"$1" <<END
{ "dapple": 1, "size": [$size, $size], "sky": [0.02, 0.03, 0.05],
  "shapes": [
    { "disc": { "center": [10, 12], "radius": 3 }, "emission": [2.0, 1.5, 0.5] },
    { "box": { "center": [20, 18], "half": [2, 6], "angle": 0.3 } },
    { "segment": { "from": [2, 28], "to": [30, 25], "width": 3 }, "extinction": 0.05 } ] }
END
}

finish() {
  printf '%d passed, %d failed\n' "$passed" "$failed"
  test "$failed" = 0
}
