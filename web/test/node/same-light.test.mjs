// The module's light is the native library's, bit for bit, from every build.
import assert from "node:assert/strict";
import path from "node:path";
import { test } from "node:test";
import { openWasm } from "../../dist/dapple/index.js";
import { dapple, inFolder, readPfm } from "./native.mjs";

const SIZE = 64, SEED = 5;
// Builds; those that differ in little from another are asked for the first runs alone.
const BUILDS = [
  [{ build: "scalar" }, Infinity],
  [{ build: "simd128" }, Infinity],
  [{ build: "threads", threads: 3 }, Infinity],
  [{ build: "threads", threads: 1 }, 4],
];
const SKIPS = ["off", "L5", "L4", "L3", "L2", "auto", "exact", "bounded"];
// Settings, and the same as options of `dapple render`.
const RUNS = [
  [{}, []],
  [{ bounces: 2 }, ["--bounces", 2]],
  [{ solver: "cascades", merge: "bilinear" }, ["--solver", "cascades", "--merge", "bilinear"]],
  [{ solver: "cascades", merge: "nearest-fix" }, ["--solver", "cascades", "--merge", "nearest-fix"]],
  ...SKIPS.map((skip) => [{ solver: "cascades", skip }, ["--solver", "cascades", "--skip", skip]]),
  [{ solver: "cascades", skip: "bounded", boundDb: 35 }, ["--skip", "bounded", "--bound", 35]],
  [{ solver: "reference", directions: 128 }, ["--solver", "reference", "--directions", 128]],
  [{ solver: "reference", directions: 64, bounces: 1 },
    ["--solver", "reference", "--directions", 64, "--bounces", 1]],
];
// Walls and lamps, coloured media, and painted walls.
const SCENES = [["arc", 20], ["fog", 3], ["bounce", 0]];

function assertSameBits(found, wanted, what) {
  assert.equal(found.length, wanted.length, what);
  const a = new Uint32Array(found.buffer), b = new Uint32Array(wanted.buffer);
  const differing = a.reduce((count, bits, i) => count + (bits === b[i] ? 0 : 1), 0);
  assert.equal(differing, 0, `${what}: ${differing} of ${a.length} values differ`);
}

async function nativeLights(folder) {
  const lights = new Map();
  for (const [family, index] of SCENES) {
    await dapple("scenes", family, "--seed", SEED, "--size", SIZE, "--out", folder);
    const scene = path.join(folder, `${family}-${String(index).padStart(2, "0")}.json`);
    for (const [settings, options] of RUNS) {
      const file = path.join(folder, "light.pfm");
      await dapple("render", scene, "-o", file, "--threads", 1, ...options);
      lights.set(`${family} ${JSON.stringify(settings)}`, (await readPfm(file)).values);
    }
  }
  return lights;
}

test("every solver and skip mode gives the native library's bits, from every build", async (t) => {
  const lights = await inFolder(nativeLights);
  for (const [options, first] of BUILDS)
    await t.test(JSON.stringify(options), async () => {
      const backend = await openWasm(options);
      try {
        for (const [family, index] of SCENES) {
          const scene = await backend.makeScene(family, SEED, index, SIZE);
          for (const [settings] of RUNS.slice(0, first)) {
            const what = `${family} ${JSON.stringify(settings)}`;
            const { light } = await backend.solve(scene, settings);
            assertSameBits(light, lights.get(what), what);
          }
        }
      } finally {
        backend.close();
      }
    });
});

test("light, rays and chosen mode are told as the command tells them", () => inFolder(async (folder) => {
  const { readFile } = await import("node:fs/promises");
  await dapple("scenes", "arc", "--seed", SEED, "--size", SIZE, "--out", folder);
  const file = path.join(folder, "stats.json");
  await dapple("render", path.join(folder, "arc-20.json"), "-o", path.join(folder, "a.pfm"), "--skip", "auto",
    "--stats", file);
  const wanted = JSON.parse(await readFile(file, "utf8"));
  const backend = await openWasm();
  try {
    const scene = await backend.makeScene("arc", SEED, 20, SIZE);
    const { stats } = await backend.solve(scene, { solver: "cascades", skip: "auto" });
    assert.equal(stats.raysFull, wanted.rays.full);
    assert.equal(stats.raysTraced, wanted.rays.traced);
    assert.deepEqual(stats.levels.map((l) => [l.probes, l.directions, l.raysTraced]),
      wanted.levels.map((l) => [l.probes, l.directions, l.traced]));
    assert.ok(["L5", "L4", "L3"].includes(stats.skip.chosen));
    const { mean, stddev } = stats.skip.signals;
    assert.ok(Math.abs(stats.skip.score - mean - stddev) < 1e-12 && mean > 0);
  } finally {
    backend.close();
  }
}));

test("shadows of lights are the command's", () => inFolder(async (folder) => {
  await dapple("scenes", "shadows", "--seed", SEED, "--size", SIZE, "--out", folder);
  const backend = await openWasm();
  try {
    for (const method of ["rays", "exact", "mrma"]) {
      const file = path.join(folder, `${method}.pfm`);
      await dapple("shadow", path.join(folder, "shadows-02.json"), "-o", file, "--method", method);
      const scene = await backend.makeScene("shadows", SEED, 2, SIZE);
      assert.equal(scene.lights.length, 1);
      const light = await backend.shadows(scene, scene.lights, { method });
      const wanted = (await readPfm(file)).values;
      // Angles come from two C libraries' atan and asin: the last bit may differ.
      const worst = light.reduce((most, v, i) => Math.max(most, Math.abs(v - wanted[i])), 0);
      assert.ok(worst < 1e-5, `${method}: off by ${worst}`);
      assert.ok(wanted.some((v) => v > 0.1), "the scene is lit at all");
    }
  } finally {
    backend.close();
  }
}));

test("two pictures are judged as the command judges them", () => inFolder(async (folder) => {
  await dapple("scenes", "arc", "--seed", SEED, "--size", SIZE, "--out", folder);
  const scene = path.join(folder, "arc-20.json"), a = path.join(folder, "a.pfm"), b = path.join(folder, "b.pfm");
  await dapple("render", scene, "-o", a, "--solver", "cascades");
  await dapple("render", scene, "-o", b);
  const wanted = JSON.parse(await dapple("compare", a, b, "--json"));
  const backend = await openWasm();
  try {
    const found = await backend.compare((await readPfm(a)).values, (await readPfm(b)).values, SIZE, SIZE);
    const names = { psnrLinear: "psnr_linear", psnrDisplay: "psnr_display", relRmse: "rel_rmse", ssim: "ssim",
      flip: "flip" };
    for (const [ours, theirs] of Object.entries(names))
      assert.ok(Math.abs(found[ours] / wanted[theirs] - 1) < 1e-5, `${ours}: ${found[ours]}, ${wanted[theirs]}`);
    assert.equal(found.pixels, SIZE * SIZE);
    const same = await backend.compare((await readPfm(a)).values, (await readPfm(a)).values, SIZE, SIZE);
    assert.equal(same.psnrDisplay, Infinity);
  } finally {
    backend.close();
  }
}));
