/** The WebGPU back end as its interface promises it: refusals, bad worlds, waiting, cancelling, and loss. */
import assert from "node:assert/strict";
import { after, before, beforeEach, test } from "node:test";
import { openBrowser } from "./browser.mjs";
import { SCENES } from "./scenes.mjs";

let opened;

/** Before each page's own scripts: devices report what nobody caught, and count what they make. */
function watchDevices() {
  globalThis.uncaught = [];
  globalThis.made = 0;
  for (const name of ["createBuffer", "createComputePipelineAsync", "createBindGroup"]) {
    const make = GPUDevice.prototype[name];
    GPUDevice.prototype[name] = function (...given) {
      globalThis.made++;
      return make.apply(this, given);
    };
  }
  const requestDevice = GPUAdapter.prototype.requestDevice;
  GPUAdapter.prototype.requestDevice = async function (...given) {
    const device = await requestDevice.apply(this, given);
    device.addEventListener("uncapturederror", ({ error }) => uncaught.push(error.message));
    return device;
  };
}

/** In the page: what tests use. */
async function prepare(scene) {
  ({ openWebgpu: globalThis.openWebgpu } = await import("/web/webgpu/index.js"));
  const { worldOf } = await import("/web/test/webgpu/scene.mjs");
  globalThis.world = worldOf(scene);
  globalThis.open = () => openWebgpu({ shaders: "/shaders/" });
  globalThis.backend = await open();
  /** What a promise is rejected with, or null. */
  globalThis.refused = (promise) =>
    promise.then(
      () => null,
      (error) => error.message,
    );
  globalThis.sum = ({ light }) => light.reduce((total, value) => total + value, 0);
}

before(async () => {
  opened = await openBrowser();
  await opened.page.addInitScript(watchDevices);
});
after(() => opened?.close());

beforeEach(async () => {
  await opened.page.goto(opened.url);
  await opened.page.evaluate(prepare, SCENES["lamps and walls"]);
});

/** Runs in the page; whatever it does, nothing may go by uncaught. */
async function inPage(work, argument) {
  const result = await opened.page.evaluate(work, argument);
  assert.deepEqual(await opened.page.evaluate(() => uncaught), []);
  return result;
}

test("the back end names itself and its adapter", async () => {
  const { name, detail } = await inPage(() => ({ name: backend.name, detail: backend.detail }));
  assert.equal(name, "webgpu");
  assert.match(detail, /\w/);
});

const REFUSED = [
  [{ solver: "reference" }, /reference/],
  [{ solver: "magic" }, /magic/],
  [{ bounces: 2 }, /bounces/],
  [{ solver: "cascades", skip: "exact" }, /exact/],
  [{ solver: "cascades", skip: "bounded" }, /bounded/],
  [{ solver: "cascades", skip: "L9" }, /L9/],
  [{ solver: "cascades", merge: "toString" }, /toString/],
  [{}, /0 x 10/, 0, 10],
  [{}, /16384/, 16385, 10],
  [{}, /allows/, 16384, 16384],
  [{ solver: "cascades" }, /allows/, 16384, 16384],
];

for (const [settings, sentence, width = 64, height = 64] of REFUSED)
  test(`${JSON.stringify(settings)} at ${width} x ${height} is refused with a sentence`, async () => {
    const ask = ([settings, width, height]) => backend.refuses(settings, width, height);
    assert.match(await inPage(ask, [settings, width, height]), sentence);
  });

test("what it can do is not refused", async () => {
  const settings = [{}, { bounces: 0 }, { solver: "cascades", skip: "auto", merge: "nearest-fix" }];
  assert.deepEqual(await inPage((all) => all.map((one) => backend.refuses(one, 512, 512)), settings), [
    null,
    null,
    null,
  ]);
});

test("a solve with refused settings is rejected with the sentence", async () => {
  assert.match(await inPage(() => refused(backend.solve(world, { bounces: 1 }))), /bounces/);
});

const BAD_WORLDS = [
  [{ width: 0 }, /0 x 150/],
  [{ width: 199 }, /emission must be a Float32Array/],
  [{ extinction: null }, /extinction must be a Float32Array/],
  [{ sky: [0, -1, 0] }, /sky/],
  [{ sky: [0, 0] }, /sky/],
];

for (const [change, sentence] of BAD_WORLDS)
  test(`a world with ${JSON.stringify(change)} is rejected`, async () => {
    assert.match(await inPage((change) => refused(backend.solve({ ...world, ...change })), change), sentence);
  });

test("a bad value is named by its pixel", async () => {
  const solveBad = ([plane, value]) => {
    world[plane][3 * (7 * world.width + 5) + 1] = value;
    return refused(backend.solve(world));
  };
  assert.match(await inPage(solveBad, ["emission", -1]), /emission of pixel \(5, 7\) is -1/);
  assert.match(await inPage(solveBad, ["emission", NaN]), /emission of pixel \(5, 7\) is NaN/);
});

test("planes are read before the promise is returned, also of a solve that waits", async () => {
  const drawOn = async () => {
    const before = sum(await backend.solve(world));
    const waiting = [backend.solve(world), backend.solve(world)];
    world.emission.fill(0);
    const [first, second] = (await Promise.all(waiting)).map(sum);
    return { before, first, second, dark: sum(await backend.solve(world)) };
  };
  const { before, first, second, dark } = await inPage(drawOn);
  assert.equal(first, before);
  assert.equal(second, before);
  assert.ok(dark < before);
});

test("the second frame at a size makes no buffer, no pipeline and no binding", async () => {
  const count = async (settings) => {
    await backend.solve(world, settings);
    const before = made;
    await backend.solve(world, settings);
    return made - before;
  };
  for (const settings of [{}, { solver: "cascades" }, { solver: "cascades", skip: "auto" }])
    assert.equal(await inPage(count, settings), 0);
});

test("sizes, media and solvers in any order give the same light", async () => {
  const solveAll = async (scenes) => {
    const { worldOf } = await import("/web/test/webgpu/scene.mjs");
    const jobs = scenes.flatMap((scene) => [{}, { solver: "cascades" }].map((settings) => [worldOf(scene), settings]));
    const inOrder = async (backend, jobs) => {
      const found = [];
      for (const [one, settings] of jobs) found.push(sum(await backend.solve(one, settings)));
      return found;
    };
    const other = await open();
    const backwards = await inOrder(other, jobs.toReversed());
    other.close();
    return [await inOrder(backend, jobs), backwards.toReversed()];
  };
  const names = ["a column", "fog that glows", "a row with a lamp", "a pixel"];
  const scenes = names.map((name) => SCENES[name]);
  const [forwards, backwards] = await inPage(solveAll, scenes);
  assert.ok(forwards.every((light) => light > 0));
  assert.deepEqual(forwards, backwards);
});

test("every stage has a name and a time, and progress ends at 1", async () => {
  const told = async (settings) => {
    const progress = [];
    const { stats } = await backend.solve(world, settings, { progress: (done) => progress.push(done) });
    return { stages: stats.stages, progress };
  };
  for (const settings of [{}, { solver: "cascades", skip: "auto" }]) {
    const { stages, progress } = await inPage(told, settings);
    assert.ok(stages.length > 2);
    for (const { name, ms } of stages) assert.ok(name.length > 0 && ms >= 0, `${name} ${ms}`);
    assert.equal(progress.at(-1), 1);
  }
});

test("a cancelled solve is rejected with the signal's reason, and the next one works", async () => {
  const cancel = async () => {
    const early = AbortSignal.abort(new Error("never mind"));
    const control = new AbortController();
    const running = refused(backend.solve(world, {}, { signal: control.signal }));
    control.abort(new Error("enough"));
    const before = await refused(backend.solve(world, {}, { signal: early }));
    return { before, during: await running, after: sum(await backend.solve(world)) };
  };
  const { before, during, after } = await inPage(cancel);
  assert.equal(before, "never mind");
  assert.equal(during, "enough");
  assert.ok(after > 0);
});

test("a closed back end settles lost, and refuses to solve", async () => {
  const close = async () => {
    const running = refused(backend.solve(world));
    backend.close();
    return [await backend.lost, await running, await refused(backend.solve(world))];
  };
  for (const sentence of await inPage(close)) assert.match(sentence, /closed/);
});

test("without WebGPU, without an adapter and without shaders it says so", async () => {
  const fail = async () => {
    const none = await refused(openWebgpu({ gpu: null }));
    const adapter = await refused(openWebgpu({ gpu: { requestAdapter: async () => null } }));
    const bare = await openWebgpu({ shaders: "/nowhere/" });
    const shaders = await refused(bare.solve(world));
    bare.close();
    return { none, adapter, shaders };
  };
  const { none, adapter, shaders } = await inPage(fail);
  assert.match(none, /no WebGPU/);
  assert.match(adapter, /no adapter/);
  assert.match(shaders, /\/nowhere\/\w+\.wgsl: 404/);
});

test("a lost device settles lost and rejects what runs; opened again it gives the same light", async () => {
  const before = await inPage(async () => sum(await backend.solve(world)));
  const session = await opened.browser.newBrowserCDPSession();
  const running = opened.page.evaluate(() => refused(Promise.all([backend.solve(world), backend.lost])));
  await session.send("Browser.crashGpuProcess").catch(() => {});
  assert.match(await running, /lost/);
  assert.match(await opened.page.evaluate(() => backend.lost), /lost/);
  const again = async () => sum(await (await open()).solve(world));
  assert.equal(await opened.page.evaluate(again), before);
});
