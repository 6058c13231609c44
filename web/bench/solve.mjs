// What a solve in the module costs beside the native library, on one thread each. Run by `npm run bench`:
//   node bench/solve.mjs [--rounds 15] [--sizes 256,512] [--solvers holographic] [--isas sse2,avx2]
//
// All take turns, round by round, so that ratios hold on a busy machine too. Times are processor time; a ratio
// is the least of one over the least of the other.
import { spawn } from "node:child_process";
import { existsSync } from "node:fs";
import { availableParallelism, cpus } from "node:os";
import { createInterface } from "node:readline";
import { fileURLToPath } from "node:url";
import { parseArgs } from "node:util";
import { loadModule } from "../dist/dapple/build.js";
import { Core } from "../dist/dapple/core.js";
import { Session } from "../dist/dapple/session.js";

const NATIVE = fileURLToPath(new URL("../../build/release/web/bench/bench_web_native", import.meta.url));
const FAMILY = "arc", INDEX = 20;
const BUILDS = ["simd128", "scalar"];

const { values: options } = parseArgs({
  options: {
    rounds: { type: "string", default: "15" },
    sizes: { type: "string", default: "256,512" },
    solvers: { type: "string", default: "holographic" },
    isas: { type: "string", default: "sse2,avx2" },
  },
});

/** A native subject: a process that solves when it is sent a line. */
function nativeSubject(size, solver, isa) {
  const child = spawn(NATIVE, [FAMILY, INDEX, size, solver, isa].map(String), { stdio: ["pipe", "pipe", "inherit"] });
  const lines = createInterface({ input: child.stdout })[Symbol.asyncIterator]();
  return {
    name: `native ${isa}`,
    solve: async () => {
      child.stdin.write("\n");
      const { value, done } = await lines.next();
      if (done) throw new Error(`${NATIVE} ended`);
      return Number(value);
    },
    end: () => child.stdin.end(),
  };
}

/** The module in this thread; nothing else runs here while it solves. */
async function moduleSubject(size, solver, build) {
  const core = await Core.start(await loadModule(build), null, { progress: () => true, number: () => {} });
  const session = new Session(core, 0, 0x7fff);
  const scene = session.scene(FAMILY, 1, INDEX, size, size);
  const kinds = { cascades: 0, reference: 1, holographic: 2 };
  session.draw(scene);
  return {
    name: `wasm ${build}`,
    solve: () => {
      const start = process.cpuUsage();
      core.check(core.call.dpl_web_solve(session.handle, kinds[solver], 0, 1, 0, 0, 0, 0, 0), session.handle);
      const { user, system } = process.cpuUsage(start);
      return (user + system) / 1000;
    },
    end: () => {},
  };
}

async function measure(size, solver, rounds) {
  const natives = options.isas.split(",").map((isa) => nativeSubject(size, solver, isa));
  const modules = await Promise.all(BUILDS.map((build) => moduleSubject(size, solver, build)));
  const subjects = [...natives, ...modules], times = subjects.map(() => []);
  for (let round = -2; round < rounds; round++) // the first are not counted: buffers, and the optimising compiler
    for (const [i, subject] of subjects.entries()) {
      const ms = await subject.solve();
      if (round >= 0) times[i].push(ms);
    }
  subjects.forEach((subject) => subject.end());
  for (const all of times) all.sort((a, b) => a - b);
  const least = times.map((all) => all[0]), middle = times.map((all) => all[rounds >> 1]);
  for (const [i, subject] of subjects.entries())
    console.log(`| ${solver} | ${size} | ${subject.name} | ${least[i].toFixed(1)} | ${middle[i].toFixed(1)} | ` +
      `${(least[i] / least[0]).toFixed(2)} |`);
}

if (!existsSync(NATIVE)) throw new Error("build/release has no bench_web_native: build that preset first");
console.log(`${cpus()[0].model}, ${availableParallelism()} processors, node ${process.version}; family ${FAMILY}, ` +
  `scene ${INDEX}, seed 1; one thread, ${options.rounds} rounds\n`);
console.log(`| solver | px | what | least CPU ms | median | times ${options.isas.split(",")[0]} |`);
console.log("|---|---|---|---|---|---|");
for (const solver of options.solvers.split(","))
  for (const size of options.sizes.split(",")) await measure(Number(size), solver, Number(options.rounds));
