# Help texts: complete, on standard output, and the same by each way of asking.
. "$(dirname "$0")/lib.sh"

expect_done --help
expect_text help.txt
expect_done help
expect_text help.txt
expect_done -h
expect_text help.txt

for command in render trace flood shadow shadow3d compare scenes study complexity info; do
  expect_done "$command" --help
  expect_text "help-$command.txt"
  expect_done "$command" -h
  expect_text "help-$command.txt"
  expect_done help "$command"
  expect_text "help-$command.txt"
  check "$command gives an example" grep -q '^Example' .stdout
  check "$command keeps to 90 columns" awk 'length > 90 { exit 1 }' .stdout
done

expect_done --version
check "a version and nothing else" grep -Exq 'dapple [0-9]+\.[0-9]+\.[0-9]+' .stdout

# Arguments behind --help do not matter, those before it must be right.
expect_done render --help --nonsense
expect_text help-render.txt

finish
