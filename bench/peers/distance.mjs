// npm's distance-transform for distance.py: `node distance.mjs NODE_MODULES`. Says its name in a line of JSON, then
// answers each line {size, count, in, out}: reads walls (bytes), transforms them `count` times, writes distances
// (doubles), and says the processor times [ms].
import { readFileSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import { join } from "node:path";
import { createInterface } from "node:readline";

const require = createRequire(join(process.argv[2], "beside.js"));
const transform = require("distance-transform");
const ndarray = require("ndarray");

function answer({ size, count, in: from, out }) {
  const walls = readFileSync(from), times = [];
  let plane;
  for (let i = 0; i < count; i++) {
    plane = ndarray(Float64Array.from(walls), [size, size]); // in place
    const start = process.cpuUsage();
    transform(plane);
    const { user, system } = process.cpuUsage(start);
    times.push((user + system) / 1e3);
  }
  writeFileSync(out, new Uint8Array(plane.data.buffer));
  return { times };
}

const say = (what) => console.log(JSON.stringify(what));
say({ name: `npm distance-transform ${require("distance-transform/package.json").version}` });
for await (const line of createInterface({ input: process.stdin }))
  say(answer(JSON.parse(line)));
