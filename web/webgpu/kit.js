/** A WebGPU device and what is made once on it: modules and pipelines. Used by plan.js; made by index.js. */

/** Limits that are asked for as high as the adapter goes: large worlds need large buffers. */
const WANTED_LIMITS = ["maxStorageBufferBindingSize", "maxBufferSize", "maxTextureDimension2D"];

/** Makes the device. @returns {Promise<GPUDevice>} */
export async function requestDevice(adapter) {
  const features = ["timestamp-query"].filter((feature) => adapter.features.has(feature));
  const limits = Object.fromEntries(WANTED_LIMITS.map((name) => [name, adapter.limits[name]]));
  return adapter.requestDevice({ requiredFeatures: features, requiredLimits: limits });
}

/** Runs `work`, and turns whatever the device complains about meanwhile into a rejection. */
export async function guarded(device, what, work) {
  const filters = ["validation", "out-of-memory", "internal"];
  for (const filter of filters) device.pushErrorScope(filter);
  let result;
  let thrown;
  try {
    result = await work();
  } catch (error) {
    thrown = error;
  }
  const complaints = await Promise.all(filters.map(() => device.popErrorScope()));
  const complaint = complaints.find((found) => found !== null);
  if (complaint) throw new Error(`WebGPU: ${what}: ${describe(complaint)}`, { cause: thrown });
  if (thrown) throw thrown;
  return result;
}

function describe(complaint) {
  const isMemory = typeof GPUOutOfMemoryError !== "undefined" && complaint instanceof GPUOutOfMemoryError;
  return isMemory ? "the device has not enough memory" : complaint.message;
}

/** What is bound to a kernel, by its words in WGSL. Left to itself a device would want textures that it can filter. */
const BINDINGS = [
  ["var<uniform>", { buffer: { type: "uniform" } }],
  ["var<storage, read>", { buffer: { type: "read-only-storage" } }],
  ["var<storage, read_write>", { buffer: { type: "storage" } }],
  ["texture_2d<f32>", { texture: { sampleType: "unfilterable-float" } }],
  ["texture_storage_2d<rgba32float, write>", { storageTexture: { format: "rgba32float" } }],
  ["sampler", { sampler: { type: "non-filtering" } }],
];

/** The layout entry of a binding that a kernel declares. */
function entryOf(code, binding) {
  const [declaration] = new RegExp(`@binding\\(${binding}\\) [^;]*;`).exec(code);
  const [, kind] = BINDINGS.find(([words]) => declaration.includes(words));
  return { binding, visibility: GPUShaderStage.COMPUTE, ...kind };
}

/**
 * Invocations of a group that goes through rows. A software adapter runs four as one vector, and what four do not want
 * it can skip; a graphics card leaves lanes idle that a group does not have.
 */
function lanesFor({ isFallbackAdapter, architecture, description }) {
  const isSoftware = isFallbackAdapter || /swiftshader|llvmpipe|warp/i.test(`${architecture} ${description}`);
  return isSoftware ? 4 : 16;
}

export class Kit {
  #library;
  #modules = new Map();
  #pipelines = new Map();
  #nearest = null;

  constructor(device, library, adapterInfo) {
    this.device = device;
    this.lanes = lanesFor(adapterInfo);
    this.#library = library;
  }

  get hasTimestamps() {
    return this.device.features.has("timestamp-query");
  }

  /** The largest buffer that a kernel may be given [byte], and the longest side of a texture [texel]. */
  get largest() {
    const { maxStorageBufferBindingSize, maxBufferSize, maxTextureDimension2D } = this.device.limits;
    return { buffer: Math.min(maxStorageBufferBindingSize, maxBufferSize), texture: maxTextureDimension2D };
  }

  /** Takes one texel, without a filter. */
  get nearest() {
    this.#nearest ??= this.device.createSampler({ label: "nearest" });
    return this.#nearest;
  }

  async #compile(kernel) {
    const module = this.device.createShaderModule({ label: kernel, code: await this.#library.kernel(kernel) });
    const { messages } = await module.getCompilationInfo();
    const errors = messages.filter((message) => message.type === "error");
    if (errors.length > 0) {
      const lines = errors.map((error) => `${kernel}:${error.lineNum}:${error.linePos}: ${error.message}`);
      throw new Error(`WebGPU: a kernel does not compile:\n${lines.join("\n")}`);
    }
    return module;
  }

  module(kernel) {
    return cached(this.#modules, kernel, () => this.#compile(kernel));
  }

  async #build(kernel, entry, constants, bindings) {
    const module = await this.module(kernel);
    const code = await this.#library.kernel(kernel);
    const entries = bindings.map((binding) => entryOf(code, binding));
    const layout = this.device.createPipelineLayout({
      bindGroupLayouts: [this.device.createBindGroupLayout({ entries })],
    });
    return this.device.createComputePipelineAsync({
      label: `${kernel}.${entry}`,
      layout,
      compute: { module, entryPoint: entry, constants },
    });
  }

  /**
   * @param {number[]} bindings those that the entry point uses
   * @returns {Promise<GPUComputePipeline>} the same for the same kernel, entry point and constants
   */
  pipeline(kernel, entry, constants = {}, bindings = []) {
    const key = `${kernel} ${entry} ${JSON.stringify(constants)}`;
    return cached(this.#pipelines, key, () => this.#build(kernel, entry, constants, bindings));
  }
}

/** A promise from a map, made if it is not there; one that fails is forgotten. */
function cached(map, key, make) {
  if (!map.has(key)) {
    const promise = make();
    map.set(key, promise);
    promise.catch(() => map.delete(key));
  }
  return map.get(key);
}
