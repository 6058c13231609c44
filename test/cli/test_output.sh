# Where results go: every format, standard output, and places that cannot be written.
. "$(dirname "$0")/lib.sh"
write_scene a.json

magic() { head -c "$2" "$1" | od -An -tx1 | tr -d ' \n'; }

expect_done render a.json -o a.png
check 'a PNG' test "$(magic a.png 4)" = 89504e47
expect_done render a.json --output a.pfm
check 'a PFM' test "$(head -n 1 a.pfm)" = PF
check 'of the right size' test "$(sed -n 2p a.pfm | tr -d '\r')" = '32 32'
run info
if grep -Eq '^exr +yes' .stdout; then
  expect_done render a.json -o a.EXR
  check 'an EXR' test "$(magic a.EXR 4)" = 762f3101
  rm -f a.EXR
else
  expect_failure 'a\.exr: .*EXR.*' render a.json -o a.exr
fi

# "-" is the PFM and nothing else.
expect_done render a.json -o -
expect_same .stdout a.pfm
check 'a PFM ends with its pixels' test "$(wc -c <.stdout)" = $((32 * 32 * 12 + $(head -n 3 .stdout | wc -c)))

# An ISA that is there gives the same picture, one that is not is an error that names those there are.
for isa in scalar sse2 avx2 avx512; do
  run render a.json -o isa.pfm --isa $isa
  if test "$status" = 0; then
    expect_same isa.pfm a.pfm
  else
    expect_status 1
    expect_stderr "dapple: --isa $isa: .* scalar.*"
    expect_no_file isa.pfm
  fi
  rm -f isa.pfm
done
expect_done render a.json -o isa.pfm --isa scalar
expect_same isa.pfm a.pfm

# Places that cannot be written: found before the scene is even read.
expect_failure 'none/a\.png: .*' render absent.json -o none/a.png
mkdir folder.png
expect_failure 'folder\.png: .*' render absent.json -o folder.png
expect_failure 'a\.json/a\.png: .*' render absent.json -o a.json/a.png
if test "$(id -u)" != 0; then
  mkdir locked
  chmod a-w locked
  expect_failure 'locked/a\.png: .*' render absent.json -o locked/a.png
fi
expect_failure 'none/s\.json: .*' render a.json -o b.png --stats none/s.json
expect_no_file b.png

# A full disk.
full='No space left on device'
"$dapple" render a.json -o - >/dev/full 2>.stderr
status=$?
last='render a.json -o - >/dev/full'
expect_status 1
expect_stderr "dapple: .*$full"
ln -s /dev/full full.png
expect_failure ".*$full" render a.json -o full.png
expect_failure ".*$full" render a.json -o b.png --stats /dev/full
for arguments in --help --version 'help render' 'render --help' info 'info --json' 'info --schedule 64x64' 'scenes --list'; do
  "$dapple" $arguments >/dev/full 2>.stderr
  status=$?
  last="$arguments >/dev/full"
  expect_status 1
  expect_stderr "dapple: standard output: $full"
  "$dapple" $arguments >&- 2>.stderr
  status=$?
  last="$arguments >&-"
  expect_status 1
  expect_stderr 'dapple: standard output: .*'
done

# A closed standard output must not become the number of the file that is read or written.
"$dapple" render a.json -o - >&- 2>.stderr
status=$?
last='render a.json -o - >&-'
expect_status 1
expect_stderr 'dapple: .*'
write_scene same.json
expect_same same.json a.json

# A reader that goes away is one line too.
{ "$dapple" render a.json -o - 2>.stderr; echo $? >.status; } | true
status=$(cat .status)
rm .status
check 'a closed pipe is 0 (written in time) or 1' test "$status" -le 1

rm -f b.png full.png
expect_clean a.json a.pfm a.png isa.pfm same.json
finish
