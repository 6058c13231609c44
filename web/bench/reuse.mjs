// What a frame of the page costs when the module keeps the last one (settings.reuse), against solving anew: a lamp
// is dragged, or nothing changes. One thread, simd128. Run in web/, after a build:
//   node bench/reuse.mjs [--frames 12] [--sizes 256,512]
//
// Both take turns, frame by frame; times are processor time of drawing and solving. Ends with an error if a bit of
// the light differs.
import { availableParallelism, cpus, loadavg } from "node:os";
import { parseArgs } from "node:util";
import { loadModule } from "../dist/dapple/build.js";
import { Core } from "../dist/dapple/core.js";
import { Session } from "../dist/dapple/session.js";
import { movingWorld } from "./moving.mjs";

const SITUATIONS = [
  { name: "nothing changes", family: "rooms", room: true, frame: () => 0 },
  { name: "a lamp moves in a closed room", family: "rooms", room: true, frame: (n) => n },
  { name: "a lamp moves among rooms with doors", family: "rooms", room: false, frame: (n) => n },
  { name: "a lamp moves in the open", family: "arc", room: false, frame: (n) => n },
];
const SOLVERS = [{ solver: "holographic" }, { solver: "cascades", merge: "bilinear-fix" }];

const { values: options } = parseArgs({
  options: { frames: { type: "string", default: "12" }, sizes: { type: "string", default: "256,512" } },
});

async function newSession() {
  const core = await Core.start(await loadModule("simd128"), null, { progress: () => true, number: () => {} });
  return new Session(core, 0);
}

function sample(session, world, settings) {
  const start = process.cpuUsage();
  const { light, stats } = session.solve(world, settings, false);
  const { user, system } = process.cpuUsage(start);
  return { ms: (user + system) / 1000, light, rays: stats.raysTraced };
}

function assertSameBits(a, b) {
  if (Buffer.compare(Buffer.from(a.buffer), Buffer.from(b.buffer)) !== 0) throw new Error("the light differs");
}

async function measure(situation, settings, size, frames) {
  const sessions = [await newSession(), await newSession()], times = [[], []], rays = [0, 0];
  const scene = sessions[0].scene(situation.family, 1, 0, size, size);
  for (let n = -2; n < frames; n++) { // the first are not counted: buffers, and the optimising compiler
    const world = movingWorld(scene, situation.room, situation.frame(n + 2));
    const found = sessions.map((session, i) => sample(session, world, { ...settings, reuse: i === 1 }));
    assertSameBits(found[0].light, found[1].light);
    for (const [i, { ms, rays: traced }] of n < 0 ? [] : found.entries()) {
      times[i].push(ms);
      rays[i] += traced;
    }
  }
  const least = times.map((all) => Math.min(...all)), most = times.map((all) => Math.max(...all));
  const pages = sessions.map((session) => session.core.memory.buffer.byteLength / 1e6);
  console.log(`| ${size} | ${situation.name} | ${settings.merge ?? settings.solver} | ${least[0].toFixed(1)} ` +
    `(${most[0].toFixed(1)}) | ${least[1].toFixed(1)} (${most[1].toFixed(1)}) | ${(least[1] / least[0]).toFixed(3)} | ` +
    `${(rays[1] / rays[0]).toFixed(3)} | ${pages[0].toFixed(0)}, ${pages[1].toFixed(0)} |`);
}

console.log(`${cpus()[0].model}, ${availableParallelism()} processors, load ${loadavg()[0].toFixed(1)}, ` +
  `node ${process.version}; wasm simd128, one thread, ${options.frames} frames, every light equal to the bit\n`);
console.log("| px | what changes | method | anew [ms] | reuse [ms] | time | rays | module's memory [MB] |");
console.log("|---|---|---|---|---|---|---|---|");
for (const size of options.sizes.split(","))
  for (const situation of SITUATIONS)
    for (const settings of SOLVERS) await measure(situation, settings, Number(size), Number(options.frames));
