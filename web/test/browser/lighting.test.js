// Methods, skip modes and views: each gives a picture and counts its rays; the truth agrees with the command's.
import assert from "node:assert/strict";
import { execFile } from "node:child_process";
import { mkdtemp, rm } from "node:fs/promises";
import { tmpdir } from "node:os";
import path from "node:path";
import { after, before, test } from "node:test";
import { promisify } from "node:util";
import { DAPPLE, brightness, drag, fill, hover, openSite, pick, pictureBytes, settled } from "./browser.js";

const run = promisify(execFile);
let site;
before(async () => (site = await openSite()));
after(() => site.close());

/** The numbers of a table of the panel by their names. */
function table(page, id) {
  return page.evaluate(
    (id) =>
      Object.fromEntries(
        [...document.querySelectorAll(`#${id} tr`)].map((row) => [...row.children].map((c) => c.textContent)),
      ),
    id,
  );
}

/** Waits for the panel, which is written a few times a second. */
async function panel(page) {
  await settled(page);
  await page.waitForSelector("#stages[aria-busy=false]");
  return {
    rays: await table(page, "ray-rows"),
    stages: await table(page, "stages"),
    chosen: await page.textContent("#chosen"),
  };
}

test("every method lights the room and counts its rays", async () => {
  const page = await site.page("scene=rooms&size=128&rays=256");
  const pictures = [];
  for (const solver of ["holographic", "cascades", "reference"]) {
    await settled(page, () => page.selectOption("#solver", solver));
    const { rays, stages } = await panel(page);
    assert.match(rays.traced, /^\d[\d.]* ?[kMG]?$/, `${solver}: ${rays.traced}`);
    assert.ok(Object.keys(stages).length >= 2, `${solver} has stages`);
    assert.ok((await brightness(page, [60, 60])) > 100, `${solver} lights the first room`);
    pictures.push(await pictureBytes(page));
  }
  for (const picture of pictures.slice(1)) {
    assert.ok(!picture.data.equals(pictures[0].data), "methods differ");
    const mean = picture.data.reduce((sum, v, i) => sum + Math.abs(v - pictures[0].data[i]), 0) / picture.data.length;
    assert.ok(mean < 8, `but not by much: ${mean.toFixed(2)} of 255`);
  }
  await page.close();
});

test("every skip mode gives a picture; L2 leaves out more than L5, exact leaves the picture as it is", async () => {
  const page = await site.page("scene=arc&size=128&solver=cascades&merge=bilinear");
  const results = {};
  for (const skip of ["off", "L5", "L4", "L3", "L2", "auto", "exact", "bounded"]) {
    await settled(page, () => pick(page, "skip", skip));
    const { rays, chosen } = await panel(page);
    results[skip] = { left: parseFloat(rays["left out"]), chosen, picture: await pictureBytes(page) };
  }
  assert.equal(results.off.left, 0);
  const ladder = ["L5", "L4", "L3", "L2"].map((mode) => results[mode].left);
  assert.deepEqual(
    [...ladder].sort((a, b) => a - b),
    ladder,
  );
  assert.ok(ladder[0] > 2 && results.exact.left > 20 && results.bounded.left > 20);
  assert.match(results.auto.chosen, /^L[543]$/);
  assert.ok(results.exact.picture.data.equals(results.off.picture.data), "exact is exact");
  await page.close();
});

test("auto shows its signals and score", async () => {
  const page = await site.page("scene=arc&size=128&solver=cascades&skip=auto");
  await panel(page);
  const signals = await table(page, "signals");
  assert.deepEqual(Object.keys(signals), ["mean", "deviation", "non-zero", "peak / average", "90 % bandwidth"]);
  const score = Number(await page.textContent("#score"));
  assert.ok(Math.abs(score - Number(signals.mean) - Number(signals.deviation)) < 0.002, "score = mean + deviation");
  await page.close();
});

test("every view shows something of its own", async () => {
  const page = await site.page("scene=stained&size=128");
  const seen = [];
  for (const view of ["light", "lit", "emission", "walls"]) {
    await settled(page, () => pick(page, "view", view));
    const { data } = await pictureBytes(page);
    assert.ok(
      data.some((value, i) => i % 4 < 3 && value > 60),
      `${view} is not black`,
    );
    assert.ok(!seen.some((other) => other.equals(data)), `${view} is a picture of its own`);
    seen.push(data);
  }
  await page.close();
});

test("bounces brighten a room that a wall hides from the lamp", async () => {
  const page = await site.page("scene=rooms&size=128");
  const dark = await brightness(page, [200, 140]);
  await settled(page, () => page.selectOption("#bounces", "4"));
  assert.ok((await brightness(page, [200, 140])) > dark);
  await page.close();
});

test("a carried lamp throws soft shadows, by every method of shadows", async () => {
  const page = await site.page("scene=discs&index=2&size=128&solver=shadows");
  const pictures = [];
  for (const shadow of ["exact", "rays", "mrma"]) {
    await page.selectOption("#shadow", shadow);
    await settled(page, () => hover(page, [20, 128]));
    pictures.push(await pictureBytes(page));
    const values = new Set(pictures.at(-1).data.filter((_, i) => i % 4 === 0));
    assert.ok(values.has(0) && values.size > 100, `${shadow}: dark, lit, and much between (${values.size})`);
    await settled(page, () => hover(page, [236, 20]));
    assert.ok(!(await pictureBytes(page)).data.equals(pictures.at(-1).data), "another place, other shadows");
  }
  const mean =
    pictures[1].data.reduce((sum, v, i) => sum + Math.abs(v - pictures[0].data[i]), 0) / pictures[0].data.length;
  assert.ok(mean < 1, `rays are near the exact shadows: ${mean.toFixed(3)} of 255`);
  await page.close();
});

test("the truth agrees with the command's in every digit shown, and shows in the difference view", async () => {
  const page = await site.page("scene=arc&index=3&size=128&solver=cascades&merge=bilinear&truth=64");
  await settled(page, () => pick(page, "view", "difference"));
  await page.waitForSelector("#truth-table:not([hidden])");
  await settled(page);
  const figures = await table(page, "truth-figures");
  const { data } = await pictureBytes(page);
  assert.ok(
    data.some((value, i) => i % 4 < 3 && value > 60),
    "differences are to be seen",
  );

  const folder = await mkdtemp(path.join(tmpdir(), "dapple-truth-"));
  const scene = path.join(folder, "arc-03.json"),
    [fast, truth] = ["fast.pfm", "truth.pfm"].map((name) => path.join(folder, name));
  await run(DAPPLE, ["scenes", "arc", "--seed", "1", "--size", "128", "--out", folder]);
  await run(DAPPLE, ["render", scene, "-o", fast, "--solver", "cascades", "--merge", "bilinear"]);
  await run(DAPPLE, ["render", scene, "-o", truth, "--solver", "reference", "--directions", "64"]);
  const { stdout } = await run(DAPPLE, ["compare", fast, truth, "--mask", scene, "--json"]);
  await rm(folder, { recursive: true });
  const native = JSON.parse(stdout);
  assert.equal(figures["PSNR, as displayed"], `${native.psnr_display.toFixed(1)} dB`);
  assert.equal(figures["PSNR, linear"], `${native.psnr_linear.toFixed(1)} dB`);
  assert.equal(figures["relative RMSE"], native.rel_rmse.toFixed(4));
  await page.close();
});

test("tracing the truth shows progress and can be cancelled; drawing makes it void", async () => {
  const page = await site.page("scene=rooms&size=128&truth=4096");
  await page.click("#truth-start");
  await page.waitForSelector("#truth-progress:not([hidden])");
  await page.click("#truth-cancel");
  await page.waitForSelector("#truth-start:not([hidden])");
  assert.equal(await page.textContent("#truth-note"), "Cancelled.");
  await page.selectOption("#truth", "64");
  await page.click("#truth-start");
  await page.waitForSelector("#truth-table:not([hidden])");
  await pick(page, "tool", "brush");
  await settled(page, () => drag(page, [30, 30], [60, 30]));
  assert.ok(await page.locator("#truth-table").isHidden());
  await page.close();
});

test("flood fill lights tiles: crisp, counted, round a corner, and by what changed", async () => {
  const page = await site.page("scene=empty&size=128&solver=flood&cell=8&range=16&sky=%23000000");
  await pick(page, "tool", "brush");
  await settled(page, () => drag(page, [40, 40], [41, 40]));
  const { data, width } = await pictureBytes(page);
  const at = (x, y) => data.subarray((y * width + x) * 4, (y * width + x) * 4 + 3);
  for (let y = 0; y < width; y++)
    for (let x = 0; x < width; x++) assert.deepEqual(at(x, y), at(x & ~7, y & ~7), `${x}, ${y} is as its tile`);
  assert.ok((await brightness(page, [60, 40])) > (await brightness(page, [90, 40])), "darker with each step");

  const open = await brightness(page, [20, 200]);
  await pick(page, "material", "wall");
  await fill(page, "radius", 32); // two tiles
  await settled(page, () => drag(page, [80, 0], [80, 200]));
  assert.ok((await brightness(page, [80, 40])) === 0, "walls are black");
  assert.ok((await brightness(page, [20, 200])) < open - 60, "and hold the light of the room's lamp back");
  await page.waitForSelector("#stages[aria-busy=false]");
  const counted = await table(page, "flood-rows");
  assert.equal(counted.tiles, "256");
  assert.equal(counted.solved, "what changed");
  assert.ok(Number(counted.visited) < 256, counted.visited);
  assert.equal(await page.textContent("#used-instead"), "");

  await settled(page, () => page.selectOption("#cell", "4"));
  await page.waitForSelector("#stages[aria-busy=false]");
  const finer = await table(page, "flood-rows");
  assert.equal(finer.tiles, "1024");
  assert.ok(parseFloat(finer.visited) > 0, "another world is lit anew");
  await page.close();
});
