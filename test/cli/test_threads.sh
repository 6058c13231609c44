# The same bytes for every number of threads.
. "$(dirname "$0")/lib.sh"
write_scene a.json 64

for arguments in '--merge bilinear' '--merge bilinear-fix' '--merge nearest-fix' '--solver reference --directions 32' \
  '--solver reference --directions 32 --bounces 2 --margin 9'; do
  expect_done render a.json -o 1.pfm --threads 1 $arguments
  for threads in 2 16; do
    expect_done render a.json -o $threads.pfm --threads $threads $arguments
    expect_same 1.pfm $threads.pfm
  done
done

expect_done render a.json -o 1.png --threads 1
expect_done render a.json -o 16.png --threads 16
expect_same 1.png 16.png

finish
