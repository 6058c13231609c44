// Flood fill in the module: the native library's light, and no more work than a change asks for.
import assert from "node:assert/strict";
import path from "node:path";
import { writeFile } from "node:fs/promises";
import { test } from "node:test";
import { DappleError, openWasm } from "../../dist/dapple/index.js";
import { dapple, inFolder, readPfm } from "./native.mjs";

const SIDE = 40;

async function withBackend(options, use) {
  const backend = await openWasm(options);
  try {
    return await use(backend);
  } finally {
    backend.close();
  }
}

/** A room with a wall in the middle, a warm lamp on the left and a cold one in the wall's foot. */
function room() {
  const walls = new Uint8Array(SIDE * SIDE), lights = new Float32Array(3 * SIDE * SIDE);
  for (let y = 8; y < SIDE; y++) walls[y * SIDE + 20] = 1;
  lights.set([4, 2, 1], 3 * (20 * SIDE + 10));
  lights.set([0.5, 1, 3], 3 * (30 * SIDE + 20));
  return { width: SIDE, height: SIDE, walls, lights };
}

/** The same room as a scene file of one pixel a cell. */
function sceneOf({ walls, lights }) {
  const shapes = [], lamps = [];
  for (let cell = 0; cell < SIDE * SIDE; cell++) {
    const center = [(cell % SIDE) + 0.5, Math.floor(cell / SIDE) + 0.5];
    const color = [...lights.subarray(3 * cell, 3 * cell + 3)];
    if (walls[cell]) shapes.push({ box: { center, half: [0.4, 0.4] } });
    if (color.some((value) => value > 0)) lamps.push({ position: center, radius: 0.5, color, intensity: 1 });
  }
  return { dapple: 1, size: [SIDE, SIDE], shapes, lights: lamps };
}

for (const falloff of ["round", "multiplicative", "euclidean", "subtractive"])
  test(`${falloff} light is that of dapple flood, from every build`, () => inFolder(async (folder) => {
    const world = room(), scene = path.join(folder, "room.json"), file = path.join(folder, "room.pfm");
    await writeFile(scene, JSON.stringify(sceneOf(world)));
    await dapple("flood", scene, "-o", file, "--falloff", falloff, "--range", 24);
    const wanted = (await readPfm(file)).values;
    for (const build of ["scalar", "simd128", "threads"])
      await withBackend({ build }, async (backend) => {
        const { light, stats } = await backend.flood(world, { falloff, range: 24 });
        assert.deepEqual(light, wanted, build);
        assert.ok(light.some((value) => value > 3) && light.some((value) => value === 0));
        assert.ok(stats.visits >= 1000 && stats.pushes >= stats.visits, "and it says what it did");
      });
  }));

test("a change is followed by few visits, to the light of a world made anew", () => withBackend({}, async (backend) => {
  const world = room(), rules = { range: 8 }, first = await backend.flood(world, rules);
  const same = await backend.flood(world, rules);
  assert.equal(same.stats.visits, 0, "nothing changed");
  assert.deepEqual(same.light, first.light);
  world.walls[18 * SIDE + 12] = 1; // a block in the warm lamp's light
  world.lights.fill(0, 3 * (30 * SIDE + 20), 3 * (30 * SIDE + 20) + 3); // the cold lamp goes out
  const changed = await backend.flood(world, rules);
  const anew = await withBackend({}, (fresh) => fresh.flood(world, rules));
  assert.deepEqual(changed.light, anew.light);
  assert.ok(!changed.stats.fromScratch && changed.stats.removals > 0);
  assert.equal(changed.light[3 * (18 * SIDE + 12)], 0, "a block is dark");
  const other = await backend.flood(world, { range: 9 });
  assert.ok(other.stats.visits > changed.stats.visits, "other rules, another world");
}));

test("a lamp brighter than all before dims nothing", () => withBackend({}, async (backend) => {
  const world = room(), at = 3 * (20 * SIDE + 11);
  const { light } = await backend.flood(world, { falloff: "multiplicative" });
  world.lights.set([40, 0, 0], 3 * (2 * SIDE + 38));
  const after = (await backend.flood(world, { falloff: "multiplicative" })).light;
  for (let c = 0; c < 3; c++) assert.ok(Math.abs(after[at + c] - light[at + c]) < 0.01 * light[at + c] + 0.01);
}));

test("what is no tile world is refused with a sentence", () => withBackend({}, async (backend) => {
  const bad = [
    [{ ...room(), width: 0 }, {}, /1 to 16384 cells a side, not 0 x 40/],
    [{ ...room(), walls: [1] }, {}, /walls is no Uint8Array of 1600/],
    [{ ...room(), walls: new Uint8Array(SIDE * SIDE).fill(2) }, {}, /a wall is 0 or 1/],
    [{ ...room(), lights: new Float32Array(3) }, {}, /lights is no Float32Array of 4800/],
    [{ ...room(), lights: new Float32Array(3 * SIDE * SIDE).fill(NaN) }, {}, /finite/],
    [room(), { range: 0 }, /1 to 4096 cells far, not 0/],
    [room(), { falloff: "magic" }, /no falloff "magic"; there are subtractive/],
  ];
  for (const [world, settings, sentence] of bad)
    await assert.rejects(backend.flood(world, settings), (error) => {
      assert.ok(error instanceof DappleError, String(error));
      assert.match(error.message, sentence);
      return true;
    });
}));
