# Wrong usage: exit status 2, one line that says what and points to the help, and nothing is done.
. "$(dirname "$0")/lib.sh"
write_scene a.json

expect_usage '' 'a command is missing'
expect_usage '' "unknown command 'paint'" paint
expect_usage '' "unknown command ''" ''
expect_usage '' "unknown option '--paint'" --paint
expect_usage '' "unexpected argument 'x'" --version x
expect_usage '' "unexpected argument 'x'" --help x
expect_usage '' "unknown command 'paint'" help paint
expect_usage '' "unexpected argument 'x'" help render x
for later in bench; do
  expect_usage '' "unknown command '$later'" "$later"
done

# render
expect_usage render 'SCENE is missing' render
expect_usage render 'SCENE is missing' render -o a.pfm
expect_usage render '-o OUT is missing' render a.json
expect_usage render '-o needs a value' render a.json -o
expect_usage render '--output needs a value' render a.json --output
expect_usage render "unexpected argument 'b.json'" render a.json b.json -o a.pfm
expect_usage render "unknown option '--glow'" render a.json -o a.pfm --glow
expect_usage render "unknown option '-x'" render a.json -o a.pfm -x
expect_usage render '--help takes no value' render --help=3
expect_usage render '.*a\.gif.*' render a.json -o a.gif
expect_usage render '.*' render a.json -o ''
expect_usage render '.*' render a.json -o a
expect_usage render "'a.png' is the scene and the output" render a.png -o a.png
expect_usage render "'-' is the output and the --stats file" render a.json -o - --stats -
expect_usage render "--solver cannot be 'magic', only one of: holographic, cascades, reference" render a.json -o a.pfm --solver magic
expect_usage render "--merge cannot be 'fix', only one of: bilinear, bilinear-fix, nearest-fix" \
  render a.json -o a.pfm --merge fix
expect_usage render "--skip cannot be 'L6', only one of: off, L5, L4, L3, L2, auto, custom, exact, bounded" render a.json -o a.pfm --skip L6
expect_usage render "--profile cannot be 'fast', only one of: default, paper" render a.json -o a.pfm --profile fast
expect_usage render '--profile paper knows no --merge but bilinear' \
  render a.json -o a.pfm --profile paper --merge bilinear-fix
expect_usage render '--skip is a setting of cascades: .*' render a.json -o a.pfm --solver reference --skip L4
expect_usage render '--skip-start and --skip-bits are settings of --skip custom' \
  render a.json -o a.pfm --skip L4 --skip-start 2
expect_usage render '--bound and --skip-seed are settings of --skip bounded' render a.json -o a.pfm --skip exact --bound 50
expect_usage render '--skip-low, --skip-high and --skip-probes are settings of --skip auto' \
  render a.json -o a.pfm --skip L4 --skip-low 0.3 --skip-high 0.5
for thresholds in '--skip-low 0.5' '--skip-high 0.5' '--skip-low 0.5 --skip-high 0.4' '--skip-low 1 --skip-high 1'; do
  expect_usage render '--skip-low and --skip-high go together, the first below the second' \
    render a.json -o a.pfm --skip auto $thresholds
done
expect_usage render "--isa cannot be 'neon', only one of: auto, scalar, sse2, avx2, avx512" \
  render a.json -o a.pfm --isa neon
for bad in 0 65 -1 x '' 1.5 1e1 ' 2' +2 99999999999999999999; do
  expect_usage render "--threads needs a whole number from 1 to 64, not '.*'" render a.json -o a.pfm --threads "$bad"
done
for bad in 0 2 6 1028; do
  expect_usage render '--directions .*' render a.json -o a.pfm --directions "$bad"
done
for bad in 0 1048577 -4; do
  expect_usage render '--directions needs a whole number from 1 to 1048576, .*' \
    render a.json -o a.pfm --solver reference --directions "$bad"
done
for bad in 0 65; do
  expect_usage render '--spacing needs a whole number from 1 to 64, .*' render a.json -o a.pfm --spacing "$bad"
done
for bad in 0 0.2 1025 nan inf 0x10 ' 1' '' e 1e999 -3; do
  expect_usage render '--interval needs a number from 0.25 to 1024, .*' render a.json -o a.pfm --interval "$bad"
done
for bad in 0 13; do
  expect_usage render '--levels needs a whole number from 1 to 12, .*' render a.json -o a.pfm --levels "$bad"
done
expect_usage render '--levels 12 is too many for --directions 1024' \
  render a.json -o a.pfm --levels 12 --directions 1024
for setting in '--merge bilinear' '--profile paper' '--spacing 2' '--interval 3' '--levels 2'; do
  expect_usage render '.* are settings of cascades, not of the reference' \
    render a.json -o a.pfm --solver reference $setting
  expect_usage render '.* are settings of cascades, not of the holographic solver' \
    render a.json -o a.pfm --solver holographic $setting
done
expect_usage render '--skip is a setting of cascades: .*' render a.json -o a.pfm --solver holographic --skip L4
expect_usage render '--directions is a setting of cascades and of the reference: .*' \
  render a.json -o a.pfm --solver holographic --directions 8

# The holographic solver's own, also where a setting of cascades has chosen them.
expect_usage render "--storage cannot be 'double', only one of: float, half" render a.json -o a.pfm --storage double
expect_usage render "--resolution cannot be '2', only one of: full, half, quarter, double" \
  render a.json -o a.pfm --resolution 2
for setting in '--storage half' '--storage float' '--resolution half'; do
  expect_usage render '--storage and --resolution are settings of the holographic solver, not of cascades' \
    render a.json -o a.pfm --merge bilinear $setting
  expect_usage render '--storage and --resolution are settings of the holographic solver, not of the reference' \
    render a.json -o a.pfm --solver reference $setting
done

for bad in -1 9 1.5; do
  expect_usage render '--bounces needs a whole number from 0 to 8, .*' \
    render a.json -o a.pfm --solver reference --bounces "$bad"
done
expect_usage render '--bounces is a setting of the holographic solver and of the reference: .*' \
  render a.json -o a.pfm --solver cascades --bounces 1
for bad in -1 4097 x; do
  expect_usage render '--margin needs a whole number from 0 to 4096, .*' render a.json -o a.pfm --margin "$bad"
done

# compare
expect_usage compare 'A is missing' compare
expect_usage compare 'B is missing' compare a.pfm
expect_usage compare "unexpected argument 'c.pfm'" compare a.pfm b.pfm c.pfm
expect_usage compare '--mask needs a value' compare a.pfm b.pfm --mask
expect_usage compare '--json takes no value' compare a.pfm b.pfm --json=1
expect_usage compare "unknown option '--mean'" compare a.pfm b.pfm --mean

# scenes
expect_usage scenes '--seed is missing' scenes arc --out d
expect_usage scenes '--out is missing' scenes arc --seed 1
expect_usage scenes '--out is missing' scenes arc --seed 1 --out ''
expect_usage scenes "there is no family 'moon'; .*" scenes moon --seed 1 --out d
expect_usage scenes '--list goes alone' scenes arc --list
expect_usage scenes "unexpected argument 'b'" scenes arc b --seed 1 --out d
for bad in -1 x '' 1.0 18446744073709551616; do
  expect_usage scenes '--seed needs a whole number from 0 to 18446744073709551615, .*' \
    scenes arc --seed "$bad" --out d
done
for bad in 0 -1 16385; do
  expect_usage scenes '--size needs a whole number from 1 to 16384, .*' scenes arc --seed 1 --out d --size "$bad"
done

# info
for bad in 512 512x 0x5 x512 16385x5 512X512 5x5x5 -1x4 ''; do
  expect_usage info '--schedule needs a size WxH with both from 1 to 16384, .*' info --schedule "$bad"
done
expect_usage info 'settings of a schedule go with --schedule' info --merge bilinear
expect_usage info 'settings of a schedule go with --schedule' info --directions 8
expect_usage info '--directions .*' info --schedule 64x64 --directions 6
expect_usage info "unexpected argument 'x'" info x

# A line break in an argument does not make a second line.
expect_usage '' "unknown command 'a.b'" $'a\nb'

expect_clean a.json
expect_no_file d
finish
