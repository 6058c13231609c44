// settings.reuse: frames of which each is much like the last have the bits of frames that are solved anew, and cost
// what has changed.
import assert from "node:assert/strict";
import { test } from "node:test";
import { openWasm } from "../../dist/dapple/index.js";
import { movingWorld } from "../../bench/moving.mjs";

const SIZE = 64, LARGE = 192; // holographic's grain is 32 columns
const BUILDS = [{ build: "scalar" }, { build: "simd128" }, { build: "threads", threads: 2 }];
const SETTINGS = [
  {},
  { bounces: 1 },
  { solver: "cascades" },
  { solver: "cascades", merge: "bilinear", skip: "auto" },
  { solver: "cascades", skip: "exact" },
];

/** Two back ends of a build: one keeps frames, the other is asked anew. */
async function withTwo(options, use) {
  const backends = [await openWasm(options), await openWasm(options)];
  try {
    await use(...backends);
  } finally {
    backends.forEach((backend) => backend.close());
  }
}

function assertSameBits(a, b, what) {
  const bits = (light) => Buffer.from(light.buffer, light.byteOffset, light.byteLength);
  assert.equal(Buffer.compare(bits(a), bits(b)), 0, what);
}

for (const options of BUILDS)
  test(`a dragged lamp has the light of frames solved anew: ${options.build}`, () =>
    withTwo(options, async (keeping, anew) => {
      const scene = await anew.makeScene("rooms", 1, 0, SIZE);
      for (const settings of SETTINGS)
        for (const room of [true, false])
          for (let number = 0; number < 3; number++) {
            const world = movingWorld(scene, room, number);
            if (settings.bounces) world.albedo = scene.albedo;
            const kept = await keeping.solve(world, { ...settings, reuse: true });
            const solved = await anew.solve(world, settings);
            assertSameBits(kept.light, solved.light, `${JSON.stringify(settings)}, frame ${number}`);
            assert.equal(kept.stats.raysFull, solved.stats.raysFull);
          }
    }));

test("what has not changed is not solved again, and of a room's lamp only what it reaches", () =>
  withTwo({ build: "simd128" }, async (backend, anew) => {
    const scene = await backend.makeScene("rooms", 1, 0, LARGE);
    for (const settings of [{}, { solver: "cascades" }]) {
      const reuse = { ...settings, reuse: true };
      await backend.solve(movingWorld(scene, true, 0), reuse);
      const same = await backend.solve(movingWorld(scene, true, 0), reuse);
      assert.equal(same.stats.raysTraced, 0);
      assert.ok(same.stats.raysFull > 0);
      const moved = movingWorld(scene, true, 1), found = await backend.solve(moved, reuse);
      const { stats } = await anew.solve(moved, settings);
      assert.ok(found.stats.raysTraced > 0 && found.stats.raysTraced < 0.7 * stats.raysTraced,
        `${found.stats.raysTraced} of ${stats.raysTraced} rays`);
    }
  }));

test("other work between frames, another size and an aborted frame lose no bit", () =>
  withTwo({ build: "simd128" }, async (keeping, anew) => {
    const scene = await anew.makeScene("rooms", 1, 0, SIZE), small = await anew.makeScene("rooms", 1, 0, 40);
    const check = async (number) => {
      const world = movingWorld(scene, true, number);
      assertSameBits((await keeping.solve(world, { reuse: true })).light, (await anew.solve(world)).light, `frame ${number}`);
    };
    await check(0);
    await keeping.distance(small);
    await check(1);
    await keeping.shadows(scene, [{ position: [20, 20], radius: 3, color: [1, 1, 1], intensity: 1 }]);
    await check(2);
    const stop = new AbortController();
    const stopped = keeping.solve(movingWorld(scene, false, 5), { reuse: true }, { signal: stop.signal });
    stop.abort(new Error("enough"));
    await assert.rejects(stopped, /enough/);
    await check(3);
    await keeping.solve(movingWorld(scene, true, 3)); // without reuse: what was kept is gone
    await check(4);
  }));
