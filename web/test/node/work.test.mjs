// How work is done: in order, with progress, abort, and sentences where it is refused.
import assert from "node:assert/strict";
import { test } from "node:test";
import { loadModule } from "../../dist/dapple/build.js";
import { Core } from "../../dist/dapple/core.js";
import { DappleError, openWasm } from "../../dist/dapple/index.js";
import { spawn } from "../../dist/dapple/port.js";
import { Session } from "../../dist/dapple/session.js";

function worldOf(width, height = width) {
  const values = 3 * width * height;
  const world = { width, height, emission: new Float32Array(values), extinction: new Float32Array(values) };
  world.emission.fill(2, 0, 3);
  world.extinction.fill(Infinity, 0, 3);
  return world;
}

async function withBackend(options, use) {
  const backend = await openWasm(options);
  try {
    return await use(backend);
  } finally {
    backend.close();
  }
}

const SLOW = { solver: "reference", directions: 1 << 14 };

test("planes are read before the promise is returned", () => withBackend({}, async (backend) => {
  const world = worldOf(16), first = backend.solve(world);
  world.emission.fill(0);
  const second = backend.solve(world);
  assert.ok((await first).light.some((v) => v > 0.01));
  assert.ok((await second).light.every((v) => v === 0));
}));

test("solves are done one after another, whatever their size", () => withBackend({}, async (backend) => {
  const order = [];
  const one = (size) => backend.solve(worldOf(size)).then(({ light }) => order.push(light.length / 3));
  await Promise.all([one(128), one(8), one(64), one(9)]);
  assert.deepEqual(order, [128 * 128, 64, 64 * 64, 81]);
}));

test("worlds need not be square", () => withBackend({}, async (backend) => {
  const { light, width, height } = await backend.solve(worldOf(70, 9));
  assert.deepEqual([width, height, light.length], [70, 9, 3 * 70 * 9]);
  assert.equal(light[0], 2);
}));

for (const shared of [true, false])
  test(`an abort ends a solve that would take minutes, ${shared ? "by a flag" : "by a new worker"}`, async () => {
    const kept = globalThis.SharedArrayBuffer;
    if (!shared) globalThis.SharedArrayBuffer = undefined;
    let backend;
    try {
      backend = await openWasm({ build: shared ? "threads" : "simd128", threads: 2 });
    } finally {
      globalThis.SharedArrayBuffer = kept;
    }
    try {
      const control = new AbortController(), reason = new Error("enough"), heard = [];
      const solve = backend.solve(worldOf(128), SLOW, {
        signal: control.signal,
        progress: (done) => {
          heard.push(done);
          control.abort(reason);
        },
      });
      const behind = backend.solve(worldOf(16));
      await assert.rejects(solve, (error) => error === reason);
      assert.ok(heard.length > 0 && heard.every((done) => done >= 0 && done <= 1));
      assert.equal((await behind).light.length, 3 * 256, "the next one is done");
    } finally {
      backend.close();
    }
  });

test("what is aborted before its turn is never begun", () => withBackend({}, async (backend) => {
  const control = new AbortController(), long = new AbortController();
  const running = backend.solve(worldOf(128), SLOW, { signal: long.signal });
  const waiting = backend.solve(worldOf(16), {}, { signal: control.signal });
  control.abort();
  await assert.rejects(waiting, { name: "AbortError" });
  long.abort();
  await assert.rejects(running, { name: "AbortError" });
  await assert.rejects(backend.solve(worldOf(8), {}, { signal: AbortSignal.abort() }), { name: "AbortError" });
}));

test("the same light comes with and without being watched", () => withBackend({ threads: 2 }, async (backend) => {
  const scene = await backend.makeScene("rooms", 1, 0, 64);
  const plain = await backend.solve(scene), watched = await backend.solve(scene, {}, { progress: () => {} });
  assert.deepEqual(watched.light, plain.light);
}));

test("mistakes are refused with a sentence that names them", () => withBackend({}, async (backend) => {
  const bad = [
    [{ ...worldOf(8), width: 0 }, {}, /1 to 16384 pixels a side, not 0 x 8/],
    [{ ...worldOf(8), height: 2.5 }, {}, /not 8 x 2.5/],
    [{ ...worldOf(8), emission: new Float32Array(5) }, {}, /emission has 5 values, not 192/],
    [{ ...worldOf(8), extinction: [0] }, {}, /extinction is no Float32Array/],
    [{ ...worldOf(8), albedo: new Float32Array(3) }, {}, /albedo has 3 values/],
    [{ ...worldOf(8), sky: [0, -1, 0] }, {}, /sky must be finite and not negative/],
    [worldOf(8), { solver: "magic" }, /no solver "magic"/],
    [worldOf(8), { solver: "toString" }, /no solver "toString"/],
    [worldOf(8), { solver: "cascades", bounces: 1 }, /cascades take no bounces/],
    [worldOf(8), { bounces: 9 }, /0 to 8 times, not 9/],
    [worldOf(8), { solver: "cascades", skip: "L9" }, /no skip mode "L9"; there are off, L5/],
    [worldOf(8), { solver: "cascades", merge: "soup" }, /no merge "soup"/],
    [worldOf(8), { solver: "reference", directions: -1 }, /directions/],
    [worldOf(8), { solver: "cascades", skip: "bounded", boundDb: 5 }, /bound/],
  ];
  for (const [world, settings, sentence] of bad)
    await assert.rejects(backend.solve(world, settings), (error) => {
      assert.ok(error instanceof DappleError, String(error));
      assert.match(error.message, sentence);
      assert.equal(error.code, "argument");
      return true;
    });
  await assert.rejects(backend.makeScene("nowhere", 1, 0, 8), /no family "nowhere"; there are arc/);
  await assert.rejects(backend.makeScene("arc", 1, 50, 8), /no such scene/);
  await assert.rejects(backend.makeScene("offscreen", 1, 0, 64), /outside its picture/);
  await assert.rejects(backend.study({ scenes: 51 }), /1 to 50 scenes/);
  assert.ok((await backend.solve(worldOf(8))).light[0] === 2, "and the back end goes on");
}));

test("not-a-number is refused, with the pixel named", () => withBackend({}, async (backend) => {
  const world = worldOf(8);
  world.emission[3 * (8 * 5 + 2)] = NaN;
  world.extinction[3 * (8 * 5 + 2)] = 1;
  await assert.rejects(backend.solve(world), /\b2, 5\b|\(2, 5\)/);
}));

test("a world that memory cannot hold is refused before work begins", () => withBackend({}, async (backend) => {
  assert.match(backend.refuses({}, 16384, 16384), /16384 x 16384 pixels take about \d+ MiB/);
  assert.equal(backend.refuses({}, 1024, 1024), null);
  assert.match(backend.refuses({}, 0, 5), /1 to 16384/);
  assert.match(backend.refuses({ solver: "cascades", bounces: 2 }, 64, 64), /no bounces/);
}));

test("memory that runs out all the same is an exception, and smaller work goes on", async () => {
  const host = { progress: () => true, number: () => {} };
  const core = await Core.start(await loadModule("simd128"), null, host), session = new Session(core, 0);
  assert.throws(() => session.resize(16384, 16384), { code: "memory", message: /no memory for \d+ x 16 bytes/ });
  assert.equal(session.solve(worldOf(8), {}, false).light[0], 2);
});

test("closing ends what is at hand, refuses what follows and settles lost", async () => {
  const backend = await openWasm();
  const solve = backend.solve(worldOf(64), SLOW);
  await new Promise((resolve) => setTimeout(resolve, 50));
  backend.close();
  await assert.rejects(solve, /closed/);
  assert.equal(await backend.lost, "closed");
  await assert.rejects(backend.solve(worldOf(8)), /no more: closed/);
});

test("a worker that dies says why, after everything else that it said", async () => {
  const code = "import { parentPort } from 'node:worker_threads'; parentPort.postMessage(1); throw new Error('oh')";
  const url = new URL(`data:text/javascript,${encodeURIComponent(code)}`);
  const dying = () => new Promise((resolve) => {
    const heard = [];
    spawn(url, (message) => heard.push(message), (sentence) => resolve([...heard, sentence]));
  });
  // Many at once: a busy machine is where an error overtakes a message.
  for (const heard of await Promise.all(Array.from({ length: 32 }, dying)))
    assert.deepEqual(heard, [1, "the worker died: oh"]);
});

test("a back end says what it is", async () => {
  for (const [options, detail] of [
    [{ build: "scalar" }, "wasm scalar, 1 thread"],
    [{ build: "simd128" }, "wasm simd128, 1 thread"],
    [{ build: "threads", threads: 2 }, "wasm simd128, 2 threads"],
    [{ threads: 1 }, "wasm simd128, 1 thread"],
  ])
    await withBackend(options, (backend) => {
      assert.equal(backend.name, "wasm");
      assert.equal(backend.detail, detail);
      assert.ok(backend.families.some((f) => f.name === "arc" && f.count === 50));
    });
});
