# Scenes that cannot be rendered: one line naming the place, exit status 1, and no file.
. "$(dirname "$0")/lib.sh"

# refuse PATTERN TEXT: a scene file of that text is refused with that message.
refuse() {
  printf '%s' "$2" >bad.json
  expect_failure "bad\.json:$1" render bad.json -o out.png --stats out.json
  expect_clean bad.json
}

place='[0-9]+:[0-9]+: .*'
head='{ "dapple": 1, "size": [16, 16]'
refuse '.*' ''
refuse "$place" '{'
refuse "$place" 'not a scene'
refuse "$place" '{ "dapple": 1, "size": [16, 16], }'
refuse "$place" '[]'
refuse "$place" '{ "size": [16, 16] }'
refuse "$place" '{ "dapple": 2, "size": [16, 16] }'
refuse "$place" '{ "dapple": 1 }'
refuse "$place" '{ "dapple": 1, "size": [0, 16] }'
refuse "$place" '{ "dapple": 1, "size": [16, -1] }'
refuse "$place" '{ "dapple": 1, "size": [1e9, 1e9] }'
refuse "$place" '{ "dapple": 1, "size": [1000000000, 16] }'
refuse "$place" '{ "dapple": 1, "size": [16] }'
refuse "$place" '{ "dapple": 1, "size": ["16", 16] }'
refuse "${place}glow.*" "$head, \"glow\": 1 }"
refuse "$place" "$head, \"sky\": [NaN, 0, 0] }"
refuse "$place" "$head, \"sky\": [1e999, 0, 0] }"
refuse "$place" "$head, \"sky\": [-1, 0, 0] }"
refuse "${place}radius.*" "$head, \"shapes\": [ { \"disc\": { \"center\": [1, 1], \"radius\": -2 } } ] }"
refuse "${place}colour.*" "$head, \"shapes\": [ { \"disc\": { \"center\": [1, 1], \"radius\": 2 }, \"colour\": 1 } ] }"
refuse "$place" "$head, \"shapes\": [ { \"disc\": { \"center\": [1, 1] } } ] }"
refuse "$place" "$head, \"shapes\": [ { } ] }"
refuse "$place" "$head, \"shapes\": [ { \"polygon\": { \"points\": [[1, 1], [2, 2]] } } ] }"
refuse "3:[0-9]+: .*absent\.png.*" "$head,

  \"images\": [ { \"emission\": \"absent.png\" } ] }"

rm bad.json
expect_failure 'absent\.json: .*' render absent.json -o out.png --stats out.json
expect_clean

# The line and the column are those of the mistake.
printf '{ "dapple": 1,\n  "size": [16, 16],\n  "shapes": 3 }\n' >bad.json
expect_failure 'bad\.json:3:[0-9]+: .*shapes.*' render bad.json -o out.pfm

# A result of before stays as it was.
echo before >out.pfm
expect_failure 'bad\.json:.*' render bad.json -o out.pfm
check 'the earlier file is untouched' grep -qx before out.pfm

finish
