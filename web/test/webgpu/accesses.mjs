/**
 * What accesses and loops cost a software adapter: node web/test/webgpu/accesses.mjs
 *
 * Processor time of the browser's GPU process for four invocations, which such an adapter runs as one vector: the least
 * of some rounds, less that of a kernel that only stores a number. The kernels of holographic cascades were written by it.
 */
import { openBrowser } from "./browser.mjs";

const SIDE = 512; // values a side
const DISPATCHES = 30;
const ROUNDS = 4;

const LOADS = [0, 1, 2, 3];
const sum = (name) => LOADS.map((i) => `${name}${i}`).join(" + ");
const each = (text) => LOADS.map((i) => text(i)).join(" ");

/** What an invocation does for the value at (x, y) = `at`, and how many accesses those are. */
const CASES = {
  "a number stored": [1, ""],
  "a vec3f of a buffer": [4, `${each((i) => `let v${i} = vectors[at + ${777 * i}];`)} s = dot(${sum("v")}, vec3f(1.0));`],
  "a texel by textureLoad()": [
    4,
    `${each((i) => `let v${i} = textureLoad(texels, vec2i(x + ${i}, y), 0);`)} s = dot(${sum("v")}, vec4f(1.0));`,
  ],
  "a texel by textureSampleLevel()": [
    4,
    `${each((i) => `let v${i} = textureSampleLevel(texels, nearest, vec2f(f32(x + ${i}), f32(y)) / SIDE, 0.0);`)}
     s = dot(${sum("v")}, vec4f(1.0));`,
  ],
  "a vec3f stored in a buffer": [1, "stored[at] = vec3f(s);"],
  "a texel stored": [1, "textureStore(kept, vec2i(x, y), vec4f(s));"],
  "a vec3f in a loop that nobody enters": [
    4,
    `for (var once = x < -1; once; once = false) {
       ${each((i) => `let v${i} = vectors[at + ${777 * i}];`)} s = dot(${sum("v")}, vec3f(1.0));
     }`,
  ],
};

const DECLARED = {
  vectors: [0, "var<storage, read> vectors: array<vec3f>;"],
  numbers: [1, "var<storage, read_write> numbers: array<f32>;"],
  stored: [2, "var<storage, read_write> stored: array<vec3f>;"],
  texels: [3, "var texels: texture_2d<f32>;"],
  nearest: [4, "var nearest: sampler;"],
  kept: [5, "var kept: texture_storage_2d<rgba32float, write>;"],
};

function kernelOf(work) {
  const used = Object.keys(DECLARED).filter((name) => name === "numbers" || work.includes(name));
  const declarations = used.map((name) => `@group(0) @binding(${DECLARED[name][0]}) ${DECLARED[name][1]}`);
  const code = `${declarations.join("\n")}
    const SIDE = ${SIDE}.0;
    @compute @workgroup_size(4)
    fn main(@builtin(local_invocation_index) lane: u32, @builtin(workgroup_id) id: vec3u) {
      let y = i32(id.x);
      var x = i32(lane);
      loop {
        let at = y * ${SIDE} + x;
        var s = f32(at);
        ${work}
        numbers[at] = s;
        x += 4;
        continuing { break if x >= ${SIDE}; }
      }
    }`;
  return { code, used: used.map((name) => [name, DECLARED[name][0]]) };
}

/** In the page: makes what all kernels share. */
async function prepare(side) {
  const adapter = await navigator.gpu.requestAdapter();
  const device = await adapter.requestDevice({ requiredFeatures: ["float32-filterable"] });
  const buffer = () => ({ buffer: device.createBuffer({ size: 32 * side * side, usage: GPUBufferUsage.STORAGE }) });
  const usage = GPUTextureUsage.TEXTURE_BINDING | GPUTextureUsage.STORAGE_BINDING;
  const texture = () => device.createTexture({ size: [side, side], format: "rgba32float", usage }).createView();
  const made = { vectors: buffer(), numbers: buffer(), stored: buffer(), texels: texture(), kept: texture() };
  globalThis.shared = { device, made: { ...made, nearest: device.createSampler() } };
}

/** In the page: runs a kernel so many times. */
async function run({ code, used, side, dispatches }) {
  const { device, made } = shared;
  const module = device.createShaderModule({ code });
  const pipeline = await device.createComputePipelineAsync({ layout: "auto", compute: { module, entryPoint: "main" } });
  const entries = used.map(([name, binding]) => ({ binding, resource: made[name] }));
  const group = device.createBindGroup({ layout: pipeline.getBindGroupLayout(0), entries });
  const encoder = device.createCommandEncoder();
  const pass = encoder.beginComputePass();
  pass.setPipeline(pipeline);
  pass.setBindGroup(0, group);
  for (let i = 0; i < dispatches; i++) pass.dispatchWorkgroups(side);
  pass.end();
  device.queue.submit([encoder.finish()]);
  await device.queue.onSubmittedWorkDone();
}

const opened = await openBrowser();
try {
  const session = await opened.browser.newBrowserCDPSession();
  const processorSeconds = async () => {
    const { processInfo } = await session.send("SystemInfo.getProcessInfo");
    return processInfo.filter(({ type }) => type === "GPU").reduce((total, { cpuTime }) => total + cpuTime, 0);
  };
  await opened.page.evaluate(prepare, SIDE);
  const least = new Map();
  for (let round = 0; round < ROUNDS; round++)
    for (const [name, [, work]] of Object.entries(CASES)) {
      const kernel = { ...kernelOf(work), side: SIDE, dispatches: DISPATCHES };
      const begin = await processorSeconds();
      await opened.page.evaluate(run, kernel);
      least.set(name, Math.min(least.get(name) ?? Infinity, (await processorSeconds()) - begin));
    }
  const [[first, base]] = least;
  const nanoseconds = (seconds) => ((1e9 * seconds) / DISPATCHES / ((SIDE * SIDE) / 4)).toFixed(1).padStart(6);
  console.log(`${first.padEnd(40)}${nanoseconds(base)} ns`);
  for (const [name, seconds] of [...least].slice(1))
    console.log(`${name.padEnd(40)}${nanoseconds((seconds - base) / CASES[name][0])} ns`);
} finally {
  await opened.close();
}
