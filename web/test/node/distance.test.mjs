// distance(): exact, and the same bits from every build; vectors go another way than the scalar build.
import assert from "node:assert/strict";
import { test } from "node:test";
import { openWasm } from "../../dist/dapple/index.js";

const WIDTH = 150, HEIGHT = 70;

/** What is opaque, from dense to sparse. */
const WALLS = {
  noise: () => random() < 1 / 8,
  thin: () => random() < 1 / 500,
  blocks: (x, y) => (Math.floor(x / 17) + Math.floor(y / 13)) % 5 === 0,
  slope: (x, y) => Math.abs(x - 2 * y) < 2,
  pixel: (x, y) => x === 140 && y === 3,
};

let state = 1;
function random() {
  state = (Math.imul(state, 1664525) + 1013904223) >>> 0;
  return state / 2 ** 32;
}

function worldOf(isWall) {
  const values = 3 * WIDTH * HEIGHT, walls = [];
  const world = { width: WIDTH, height: HEIGHT, emission: new Float32Array(values), extinction: new Float32Array(values) };
  for (let y = 0; y < HEIGHT; y++)
    for (let x = 0; x < WIDTH; x++)
      if (isWall(x, y)) {
        walls.push([x, y]);
        world.extinction.fill(Infinity, 3 * (y * WIDTH + x), 3 * (y * WIDTH + x) + 3);
      }
  return { world, wanted: bruteForce(walls) };
}

function bruteForce(walls) {
  const distance = new Float32Array(WIDTH * HEIGHT);
  for (let i = 0; i < distance.length; i++) {
    const x = i % WIDTH, y = Math.floor(i / WIDTH);
    let least = Infinity;
    for (const [a, b] of walls) least = Math.min(least, (x - a) ** 2 + (y - b) ** 2);
    distance[i] = Math.sqrt(least);
  }
  return distance;
}

const worlds = Object.entries(WALLS).map(([name, isWall]) => ({ name, ...worldOf(isWall) }));

for (const options of [{ build: "scalar" }, { build: "simd128" }, { build: "threads", threads: 2 }])
  test(`distances are exact: ${options.build}`, async () => {
    const backend = await openWasm(options);
    try {
      for (const { name, world, wanted } of worlds) {
        const found = await backend.distance(world);
        assert.equal(found.findIndex((value, i) => value !== wanted[i]), -1, name);
      }
    } finally {
      backend.close();
    }
  });
