/**
 * The WebGPU back end on a graphics card, without a browser: parity with the command `dapple`, then times of frames.
 *
 *     deno run --allow-all web/test/webgpu/card.mjs                # wgpu, as in Firefox
 *     DAWN=path/to/dawn.node deno run --allow-all web/test/webgpu/card.mjs    # Dawn, as in Chromium
 *
 * Wants a driver for the card (Vulkan, Metal) and the command, built in build/release or named by DAPPLE. Run by hand:
 * `make test` has the software adapter of Chromium instead. SIZES=512,1024 and FRAMES in the environment.
 */
import { execFileSync } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import { tmpdir } from "node:os";
import { join } from "node:path";
import process from "node:process";
import { fileURLToPath } from "node:url";
import { openWebgpu } from "../../webgpu/index.js";
import { compare, readPfm } from "./compare.mjs";
import { worldOf } from "./scene.mjs";
import { SCENES, paperLike } from "./scenes.mjs";

const repository = fileURLToPath(new URL("../../../", import.meta.url));
const dapple = process.env.DAPPLE ?? join(repository, "build/release/tools/dapple/dapple");
const FRAMES = Number(process.env.FRAMES ?? 20);
const SIZES = (process.env.SIZES ?? "512,1024,2048").split(",").map(Number);
const LARGEST_COMPARED = 512;

const SETTINGS = [
  { solver: "holographic" },
  { solver: "cascades", merge: "bilinear" },
  { solver: "cascades", merge: "bilinear", skip: "auto" },
  { solver: "cascades", merge: "bilinear-fix" },
];

/** What stands for navigator.gpu. */
function gpuOfRuntime() {
  if (!process.env.DAWN) return globalThis.navigator?.gpu;
  const dawn = createRequire(import.meta.url)(process.env.DAWN);
  Object.assign(globalThis, dawn.globals);
  return dawn.create([]);
}

const nameOf = (settings) => Object.values(settings).join(", ");

/** The library's own picture. */
function renderNative(folder, scene, settings) {
  const [file, picture] = ["scene.json", "native.pfm"].map((name) => join(folder, name));
  writeFileSync(file, JSON.stringify({ dapple: 1, ...scene }));
  const flags = Object.entries(settings).flatMap(([name, value]) => [`--${name}`, String(value)]);
  execFileSync(dapple, ["render", file, "-o", picture, ...flags]);
  const bytes = readFileSync(picture);
  return readPfm(bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.byteLength)).light;
}

async function printParity(backend, folder) {
  console.log("\n| scene | method | rel_rmse | pixels that differ by more than 1e-3 |\n|---|---|---|---|");
  const scenes = { ...SCENES, "lamps and walls, 512 x 512": paperLike(LARGEST_COMPARED, LARGEST_COMPARED) };
  for (const [name, scene] of Object.entries(scenes))
    for (const settings of SETTINGS) {
      const world = worldOf(scene);
      const { light } = await backend.solve(world, settings);
      const found = compare(light, renderNative(folder, scene, settings), world.extinction);
      const percent = (100 * found.differing).toFixed(4);
      console.log(`| ${name} | ${nameOf(settings)} | ${found.relRmse.toExponential(1)} | ${percent} % |`);
    }
}

const median = (values) => values.toSorted((a, b) => a - b)[values.length >> 1];

/** Milliseconds of each of FRAMES solves, after two that are not timed. */
async function timeFrames(backend, world, settings) {
  const frames = [];
  for (let i = -2; i < FRAMES; i++) {
    const start = performance.now();
    const { stats } = await backend.solve(world, settings);
    const clock = performance.now() - start;
    const device = stats.stages.reduce((sum, { ms }) => sum + ms, 0);
    if (i >= 0) frames.push({ clock, device });
  }
  return frames;
}

async function printTimes(backend) {
  const of = (frames, kind) => {
    const values = frames.map((frame) => frame[kind]);
    return `${Math.min(...values).toFixed(2)} (${median(values).toFixed(2)})`;
  };
  console.log(`\nLeast of ${FRAMES} frames (median) [ms]. On the device: by its own clock; whole: from planes in memory to light in memory.`);
  console.log("\n| size | method | on the device | whole |\n|---|---|---|---|");
  for (const size of SIZES) {
    const world = worldOf(paperLike(size, size, size / 512));
    for (const settings of SETTINGS) {
      const refused = backend.refuses(settings, size, size);
      if (refused) console.log(`| ${size} | ${nameOf(settings)} | ${refused} | |`);
      if (refused) continue;
      const frames = await timeFrames(backend, world, settings);
      console.log(`| ${size} | ${nameOf(settings)} | ${of(frames, "device")} | ${of(frames, "clock")} |`);
    }
  }
}

const folder = mkdtempSync(join(tmpdir(), "dapple-card-"));
try {
  const shaders = new URL("../../../shaders/", import.meta.url);
  const backend = await openWebgpu({ gpu: gpuOfRuntime(), shaders, powerPreference: "high-performance" });
  console.log(backend.detail);
  await printParity(backend, folder);
  await printTimes(backend);
  backend.close();
} finally {
  rmSync(folder, { recursive: true });
}
