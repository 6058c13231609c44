/** A WebGPU device and what is made once on it: modules and pipelines. Used by plan.js; made by index.js. */

/** Limits that are asked for as high as the adapter goes: large worlds need large buffers. */
const WANTED_LIMITS = ["maxStorageBufferBindingSize", "maxBufferSize"];

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

export class Kit {
  #library;
  #modules = new Map();
  #pipelines = new Map();

  constructor(device, library) {
    this.device = device;
    this.#library = library;
  }

  get hasTimestamps() {
    return this.device.features.has("timestamp-query");
  }

  /** The largest buffer that a kernel may be given [byte]. */
  get largestBuffer() {
    return Math.min(this.device.limits.maxStorageBufferBindingSize, this.device.limits.maxBufferSize);
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

  async #build(kernel, entry, constants) {
    const module = await this.module(kernel);
    return this.device.createComputePipelineAsync({
      label: `${kernel}.${entry}`,
      layout: "auto",
      compute: { module, entryPoint: entry, constants },
    });
  }

  /** @returns {Promise<GPUComputePipeline>} the same for the same arguments */
  pipeline(kernel, entry, constants = {}) {
    const key = `${kernel} ${entry} ${JSON.stringify(constants)}`;
    return cached(this.#pipelines, key, () => this.#build(kernel, entry, constants));
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
