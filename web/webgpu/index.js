/** The WebGPU back end: openWebgpu(). The interface is ../module/backend.d.ts. */
import * as cascades from "./cascades.js";
import * as holographic from "./holographic.js";
import { Kit, guarded, requestDevice } from "./kit.js";
import { ShaderLibrary } from "./shaders.js";
import { MAX_SIZE, takeWorld } from "./world.js";

const SOLVERS = {
  holographic: { ...holographic, make: holographic.HolographicPlan.make },
  cascades: { ...cascades, make: cascades.CascadesPlan.make },
};

const MEGABYTE = 2 ** 20;

/** Why a world of this size is too large for the device, or null. */
function sizeRefusal(solver, width, height, most, media) {
  if (![width, height].every((n) => Number.isInteger(n) && n >= 1 && n <= MAX_SIZE))
    return `a world is 1 to ${MAX_SIZE} pixels wide and high, not ${width} x ${height}`;
  const bytes = solver.largestBuffer(width, height, media);
  const side = solver.largestTexture?.(width, height, media) ?? 0;
  if (side > most.texture)
    return `${width} x ${height} pixels need a texture of ${side} texels a side; this device allows ${most.texture}`;
  if (bytes <= most.buffer) return null;
  const [wanted, allowed] = [bytes, most.buffer].map((n) => Math.ceil(n / MEGABYTE));
  return `${width} x ${height} pixels need a buffer of ${wanted} MiB; this device allows ${allowed}`;
}

function settingsRefusal({ solver = "holographic", ...settings }) {
  if (solver === "reference") return "the reference solver is not on WebGPU; the wasm back end has it";
  if (!Object.hasOwn(SOLVERS, solver)) return `there is no solver "${solver}"`;
  return SOLVERS[solver].refusal(settings);
}

class WebgpuBackend {
  name = "webgpu";
  #kit;
  #plans = new Map(); // by solver: the last one, with its key
  #tail = Promise.resolve();
  #why = null; // the back end is no more
  #settleLost;
  #abandon = null; // rejects the solve that runs

  constructor(kit, detail) {
    this.#kit = kit;
    this.detail = detail;
    this.lost = new Promise((settle) => (this.#settleLost = settle));
    kit.device.lost.then(({ reason, message }) => this.#end(`the WebGPU device was lost: ${message || reason}`));
  }

  #end(why) {
    this.#why ??= why;
    this.#settleLost(this.#why);
    this.#abandon?.(new Error(this.#why));
  }

  refuses(settings, width, height) {
    const refused = settingsRefusal(settings ?? {});
    if (refused) return refused;
    return sizeRefusal(SOLVERS[settings?.solver ?? "holographic"], width, height, this.#kit.largest);
  }

  solve(world, settings = {}, options = {}) {
    let taken;
    try {
      taken = takeWorld(world);
      const refused = this.refuses(settings, taken.width, taken.height);
      if (refused) throw new Error(refused);
    } catch (error) {
      return Promise.reject(error);
    }
    const turn = this.#tail.then(() => this.#solveNow(taken, settings, options));
    this.#tail = turn.catch(() => {});
    return untilAborted(turn, options.signal);
  }

  /** The solver's plan for this world: the last one, if it is that, or a new one. */
  async #planFor(name, world, settings) {
    const solver = SOLVERS[name];
    const key = solver.keyOf(world, settings);
    const last = this.#plans.get(name);
    if (last?.key === key) return last.plan;
    const refused = sizeRefusal(solver, world.width, world.height, this.#kit.largest, world.media);
    if (refused) throw new Error(refused);
    last?.plan.destroy();
    this.#plans.delete(name);
    const make = () => solver.make(this.#kit, world, settings);
    const plan = await guarded(this.#kit.device, `${world.width} x ${world.height} pixels`, make);
    this.#plans.set(name, { key, plan });
    return plan;
  }

  async #solveNow(world, settings, { signal, progress }) {
    signal?.throwIfAborted();
    if (this.#why) throw new Error(this.#why);
    progress?.(0);
    const { light, levels, skip, stages } = await this.#whileAlive(async () => {
      const plan = await this.#planFor(settings.solver ?? "holographic", world, settings);
      return plan.solve(world, settings);
    });
    progress?.(1);
    const sum = (name) => levels.reduce((total, level) => total + level[name], 0);
    const stats = { levels, raysFull: sum("raysFull"), raysTraced: sum("raysTraced"), skip, stages };
    return { width: world.width, height: world.height, light, stats };
  }

  /** What `work` returns, or a rejection as soon as the device is lost. */
  #whileAlive(work) {
    return new Promise((resolve, reject) => {
      this.#abandon = reject;
      work().then(resolve, reject);
    });
  }

  close() {
    this.#end("the back end was closed");
    this.#kit.device.destroy();
  }
}

/** The promise, or a rejection as soon as the signal says so; the device finishes what it has begun. */
function untilAborted(promise, signal) {
  if (!signal) return promise;
  return new Promise((resolve, reject) => {
    const abort = () => reject(signal.reason);
    if (signal.aborted) abort();
    signal.addEventListener("abort", abort, { once: true });
    promise.then(resolve, reject).finally(() => signal.removeEventListener("abort", abort));
  });
}

/** The adapter's own words. */
function detailOf({ vendor, architecture, device, description }) {
  return description || [vendor, architecture, device].filter(Boolean).join(" ") || "unnamed adapter";
}

/**
 * Opens the WebGPU back end.
 * @param {import("./index.js").WebgpuOptions} [options]
 * @returns {Promise<import("dapple").Backend>} rejected with one sentence where there is no WebGPU
 */
export async function openWebgpu({ gpu = globalThis.navigator?.gpu, shaders, powerPreference } = {}) {
  if (!gpu) throw new Error("there is no WebGPU here");
  const adapter = await gpu.requestAdapter({ powerPreference });
  if (!adapter) throw new Error("WebGPU has no adapter");
  const device = await requestDevice(adapter);
  return new WebgpuBackend(new Kit(device, new ShaderLibrary(shaders), adapter.info), detailOf(adapter.info));
}
