# Scene families: listed, written, reproducible, and readable by render.
. "$(dirname "$0")/lib.sh"

expect_done scenes --list
expect_stdout '^arc +50 '

expect_done scenes arc --seed 1 --out deep/er/one --size 64
check 'nothing printed' test ! -s .stdout
check '50 scenes' test "$(find deep/er/one -name 'arc-*.json' | wc -l)" = 50
expect_file deep/er/one/arc-00.json
expect_file deep/er/one/arc-49.json

expect_done scenes arc --seed 1 --out again/ --size 64
check 'the same seed gives the same bytes' diff -r deep/er/one again
expect_done scenes arc --seed 1 --out again --size 64
check 'an existing folder is used' diff -r deep/er/one again
expect_done scenes arc --seed 2 --out other --size 64
check 'another seed gives other scenes' test "$(cat other/* | cksum)" != "$(cat again/* | cksum)"
expect_done scenes arc --seed 18446744073709551615 --out largest --size 64
expect_done render again/arc-49.json -o a.png
expect_file a.png

# Without a name: every family of the list.
expect_done scenes --seed 3 --out all --size 64
run scenes --list
total=$(awk '{ sum += $2 } END { print sum }' .stdout)
check 'all families' test "$(find all -name '*.json' | wc -l)" = "$total"

# Folders that cannot be made.
echo file >taken
expect_failure 'taken: .*' scenes arc --seed 1 --out taken --size 64
expect_failure 'taken: .*' scenes arc --seed 1 --out taken/deep --size 64

finish
