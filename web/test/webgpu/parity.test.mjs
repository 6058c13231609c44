/**
 * The WebGPU back end against the library on the CPU: same pictures, same counted rays. Wants the command, built in
 * build/release or named by DAPPLE. Drivers may round differently and so turn a few rays aside: hence bounds, not
 * equality; on the software adapter of Chromium the pictures are equal.
 */
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { existsSync, readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { openBrowser, repository } from "./browser.mjs";
import { SCENES } from "./scenes.mjs";

const MOST_DIFFERING = 0.002; // of the free pixels, by more than 1e-3
const MOST_REL_RMSE = 1e-3;

const dapple = process.env.DAPPLE ?? join(repository, "build/release/tools/dapple/dapple");
let opened;

before(async () => {
  assert.ok(existsSync(dapple), `${dapple} is not there: build the target dapple, or set DAPPLE`);
  opened = await openBrowser();
});
after(() => opened?.close());

/** What the library gives: the picture as /out/NAME.pfm, and its statistics. */
function renderNative(scene, settings) {
  const [file, picture, stats] = ["scene.json", "native.pfm", "stats.json"].map((name) => join(opened.out, name));
  writeFileSync(file, JSON.stringify({ dapple: 1, ...scene }));
  const flags = Object.entries(settings).flatMap(([name, value]) => [`--${name}`, String(value)]);
  execFileSync(dapple, ["render", file, "-o", picture, "--stats", stats, ...flags]);
  return JSON.parse(readFileSync(stats, "utf8"));
}

/** In the page: solves the scene and compares it with the library's picture. As on a graphics card: with its groups. */
async function solveInPage({ scene, settings, likeCard }) {
  const { openWebgpu } = await import("/web/webgpu/index.js");
  const { worldOf } = await import("/web/test/webgpu/scene.mjs");
  const { compare, readPfm } = await import("/web/test/webgpu/compare.mjs");
  globalThis.backends ??= new Map();
  const card = {
    async requestAdapter() {
      const adapter = await navigator.gpu.requestAdapter();
      const { features, limits } = adapter;
      return { features, limits, info: {}, requestDevice: (wanted) => adapter.requestDevice(wanted) };
    },
  };
  if (!backends.has(likeCard))
    backends.set(likeCard, await openWebgpu({ shaders: "/shaders/", gpu: likeCard ? card : navigator.gpu }));
  const world = worldOf(scene);
  const { light, stats } = await backends.get(likeCard).solve(world, settings);
  const native = readPfm(await (await fetch("/out/native.pfm")).arrayBuffer());
  return { stats, ...compare(light, native.light, world.extinction) };
}

async function check(name, settings, likeCard = false) {
  const scene = SCENES[name];
  const native = renderNative(scene, settings);
  const found = await opened.page.evaluate(solveInPage, { scene, settings, likeCard });
  assert.ok(found.relRmse <= MOST_REL_RMSE, `rel_rmse ${found.relRmse}`);
  assert.ok(found.differing <= MOST_DIFFERING, `${found.differing} of the pixels differ`);
  assert.equal(found.walls, 0, "walls show their own emission");
  return { native, found };
}

/** Levels as the library's statistics have them. */
function levelsLike(native, stats, names) {
  const levels = stats.levels.map(({ probes, directions, raysFull, raysTraced }, level) => {
    const all = { level, probes, directions, full: raysFull, traced: raysTraced };
    return Object.fromEntries(names.map((key) => [key, all[key]]));
  });
  const used = native.levels.filter(({ full }) => full > 0); // a world of one pixel has levels without segments
  const wanted = used.map((level) => Object.fromEntries(names.map((key) => [key, level[key]])));
  assert.deepEqual(levels, wanted);
}

async function checkCascades(name, settings) {
  const { native, found } = await check(name, { solver: "cascades", ...settings });
  levelsLike(native, found.stats, ["level", "probes", "directions", "full", "traced"]);
  assert.equal(found.stats.raysTraced, native.rays.traced);
  return { native, found };
}

for (const name of Object.keys(SCENES)) {
  test(`holographic: "${name}" is the picture of the CPU`, async () => {
    const { native, found } = await check(name, { solver: "holographic" });
    levelsLike(native, found.stats, ["level", "probes", "directions", "full"]);
  });
  for (const merge of ["bilinear", "bilinear-fix", "nearest-fix"])
    test(`cascades, ${merge}: "${name}" is the picture of the CPU, from as many rays`, () =>
      checkCascades(name, { merge }));
}

for (const name of ["lamps and walls", "tinted glass", "a tower"])
  test(`holographic: "${name}" is the same picture with the groups of a graphics card`, () =>
    check(name, { solver: "holographic" }, true));

for (const skip of ["L5", "L4", "L3", "L2"])
  for (const merge of ["bilinear", "bilinear-fix"])
    test(`cascades, ${merge}, skip ${skip}: the picture of the CPU, from as many rays`, async () => {
      const { found } = await checkCascades("lamps and walls", { merge, skip });
      assert.equal(found.stats.skip.chosen, skip);
    });

for (const name of ["lamps and walls", "fog that glows", "tinted glass"])
  test(`cascades, auto: "${name}" gets the rung that the CPU chooses`, async () => {
    const { native, found } = await checkCascades(name, { merge: "bilinear", skip: "auto" });
    const { chosen, score, signals } = found.stats.skip;
    assert.match(chosen, /^L[543]$/);
    assert.equal(native.rays.traced, found.stats.raysTraced);
    assert.ok(Math.abs(signals.mean + signals.stddev - score) < 1e-9);
    assert.deepEqual(Object.keys(signals), ["mean", "stddev", "non_zero", "peak_to_average", "bandwidth90"]);
  });
