// The CPU back end: the Backend of backend.d.ts, and what the library has besides. Solves run in a worker.
import { hasSharedMemory, hasSimd, loadModule, processors } from "./build.js";
import { DappleError } from "./core.js";
import { Crew } from "./crew.js";

const MAX_SIZE = 16384, MAX_BOUNCES = 8, MAX_THREADS = 16, MAX_RANGE = 4096;
// What a world, its planes and a solver take, measured with coloured media, rounded up [byte per pixel]; holographic
// bounces take more, and so does keeping the last frame. And what a module may have (web/wasm/CMakeLists.txt).
const BYTES_PER_PIXEL = { holographic: 410, cascades: 340, reference: 125 };
const BYTES_OF_BOUNCES = 330;
const BYTES_OF_REUSE = 240;
const MEMORY = 2 ** 31;

function bytesPerPixel(solver, bounces) {
  return BYTES_PER_PIXEL[solver] + (solver === "holographic" && bounces > 0 ? BYTES_OF_BOUNCES : 0);
}

/** Does the last frame fit beside the solver? */
function hasRoomToReuse({ solver = "holographic", bounces = 0 }, { width, height }) {
  return width * height * (bytesPerPixel(solver, bounces) + BYTES_OF_REUSE) <= MEMORY;
}

/** What is wrong with a world, or null. */
function faultOf(world) {
  const { width, height } = world;
  if (!Number.isInteger(width) || !Number.isInteger(height) || width < 1 || height < 1)
    return `a world is 1 to ${MAX_SIZE} pixels a side, not ${width} x ${height}`;
  for (const name of ["emission", "extinction", "albedo"]) {
    const plane = world[name];
    if (name === "albedo" && plane === undefined) continue;
    if (!(plane instanceof Float32Array)) return `${name} is no Float32Array`;
    if (plane.length !== 3 * width * height)
      return `${name} has ${plane.length} values, not ${3 * width * height} for ${width} x ${height} pixels`;
  }
  return null;
}

/** What is wrong with a tile world or its rules, or null. */
function floodFaultOf({ width, height, walls, lights }, { range = 16 }) {
  if (![width, height].every((side) => Number.isInteger(side) && side >= 1 && side <= MAX_SIZE))
    return `a tile world is 1 to ${MAX_SIZE} cells a side, not ${width} x ${height}`;
  if (!(walls instanceof Uint8Array) || walls.length !== width * height)
    return `walls is no Uint8Array of ${width * height} values`;
  if (!(lights instanceof Float32Array) || lights.length !== 3 * width * height)
    return `lights is no Float32Array of ${3 * width * height} values`;
  if (walls.some((wall) => wall > 1)) return "a wall is 0 or 1";
  if (!lights.every((value) => value >= 0 && value < Infinity)) return "lights must be finite and not negative";
  if (!Number.isInteger(range) || range < 1 || range > MAX_RANGE)
    return `light reaches 1 to ${MAX_RANGE} cells far, not ${range}`;
  return null;
}

/** A world's planes as they are now, and their buffers. */
function copyWorld({ width, height, emission, extinction, albedo, sky }) {
  const world = { width, height, emission: emission.slice(), extinction: extinction.slice(), sky: sky && [...sky] };
  if (albedo) world.albedo = albedo.slice();
  return { world, buffers: [world.emission, world.extinction, world.albedo].flatMap((p) => (p ? p.buffer : [])) };
}

class WasmBackend {
  name = "wasm";
  #plan;
  #crew;
  #stop; // Int32Array in shared memory, or null: then a worker is ended to stop it
  #last = Promise.resolve();
  #closed = null;
  #lose;

  constructor(plan, build, threads) {
    this.#plan = plan;
    this.#stop = plan.stopFlag ? new Int32Array(plan.stopFlag) : null;
    this.build = build;
    this.threads = threads;
    this.lost = new Promise((resolve) => (this.#lose = resolve));
  }

  async start() {
    this.#crew = await Crew.start(this.#plan, (text) => this.#end(text));
    const { isa, families } = this.#crew.opened;
    this.families = families;
    this.detail = `wasm ${isa}, ${this.threads} thread${this.threads === 1 ? "" : "s"}`;
    return this;
  }

  #end(text) {
    if (this.#closed) return;
    this.#closed = text;
    this.#lose(text);
  }

  close() {
    this.#end("closed");
    this.#crew.end();
  }

  /** Runs a request when all before it are done. `transfer` are buffers of the message. */
  #ask(message, transfer, { signal, progress, part } = {}) {
    if (signal?.aborted) return Promise.reject(signal.reason);
    const mine = this.#last.then(() => this.#askNow(message, transfer, { signal, progress, part }));
    this.#last = mine.then(() => {}, () => {});
    return new Promise((resolve, reject) => {
      // What is aborted while it waits for its turn does not wait any longer.
      const abort = () => reject(signal.reason);
      signal?.addEventListener("abort", abort);
      mine.then(resolve, reject).finally(() => signal?.removeEventListener("abort", abort));
    });
  }

  async #askNow(message, transfer, { signal, progress, part }) {
    if (this.#closed) throw new DappleError("failed", `the back end is no more: ${this.#closed}`);
    signal?.throwIfAborted();
    let restarted = null;
    const stop = () => {
      if (this.#stop) Atomics.store(this.#stop, 0, 1);
      else restarted = this.#restart();
    };
    signal?.addEventListener("abort", stop);
    try {
      return await this.#crew.ask(message, transfer, (heard) => {
        if ("part" in heard) part?.(heard.part);
        else progress?.(heard.progress);
      });
    } catch (error) {
      throw signal?.aborted ? signal.reason : error;
    } finally {
      signal?.removeEventListener("abort", stop);
      if (this.#stop) Atomics.store(this.#stop, 0, 0);
      await restarted;
    }
  }

  async #restart() {
    this.#crew.end();
    try {
      this.#crew = await Crew.start(this.#plan, (text) => this.#end(text));
      if (this.#closed) this.#crew.end();
    } catch (error) {
      this.#end(error.message);
    }
  }

  refuses(settings, width, height) {
    const solver = settings.solver ?? "holographic", bounces = settings.bounces ?? 0;
    if (!Object.hasOwn(BYTES_PER_PIXEL, solver)) return `there is no solver "${solver}"`;
    if (!(width >= 1 && height >= 1 && width <= MAX_SIZE && height <= MAX_SIZE))
      return `a world is 1 to ${MAX_SIZE} pixels a side, not ${width} x ${height}`;
    if (!Number.isInteger(bounces) || bounces < 0 || bounces > MAX_BOUNCES)
      return `light bounces 0 to ${MAX_BOUNCES} times, not ${bounces}`;
    if (solver === "cascades" && bounces > 0) return "cascades take no bounces";
    const needed = width * height * bytesPerPixel(solver, bounces);
    if (needed > MEMORY)
      return `${width} x ${height} pixels take about ${Math.round(needed / 2 ** 20)} MiB, and there are ` +
        `${MEMORY / 2 ** 20}`;
    return null;
  }

  #checked(fault) {
    if (fault) throw new DappleError("argument", fault);
  }

  async solve(world, settings = {}, options = {}) {
    this.#checked(faultOf(world) ?? this.refuses(settings, world.width, world.height));
    const copy = copyWorld(world);
    const watched = Boolean(options.progress || options.signal), asked = { ...settings };
    asked.reuse = Boolean(asked.reuse) && hasRoomToReuse(asked, world);
    return this.#ask({ type: "solve", world: copy.world, settings: asked, watched }, copy.buffers, options);
  }

  async distance(world, options = {}) {
    this.#checked(faultOf(world));
    const copy = copyWorld(world);
    return this.#ask({ type: "distance", world: copy.world }, copy.buffers, options);
  }

  async shadows(world, lights, options = {}) {
    this.#checked(faultOf(world));
    const copy = copyWorld(world);
    const method = options.method ?? "rays";
    const message = { type: "shadows", world: copy.world, lights: structuredClone(lights), method };
    return this.#ask(message, copy.buffers, options);
  }

  async flood(world, settings = {}, options = {}) {
    this.#checked(floodFaultOf(world, settings));
    const { width, height } = world, walls = world.walls.slice(), lights = world.lights.slice();
    const message = { type: "flood", world: { width, height, walls, lights }, settings: { ...settings } };
    return this.#ask(message, [walls.buffer, lights.buffer], options);
  }

  async makeScene(family, seed, index, width, height = width) {
    const known = this.families.find((f) => f.name === family);
    this.#checked(known ? null : `there is no family "${family}"; there are ` +
      this.families.map((f) => f.name).join(", "));
    this.#checked(this.refuses({ solver: "reference" }, width, height));
    return this.#ask({ type: "scene", family, seed, index, width, height }, []);
  }

  async compare(test, reference, width, height, mask) {
    const values = 3 * width * height;
    this.#checked(this.refuses({ solver: "reference" }, width, height));
    for (const [name, plane] of Object.entries({ test, reference }))
      this.#checked(plane instanceof Float32Array && plane.length === values ? null
        : `${name} is no Float32Array of ${values} values`);
    this.#checked(mask && mask.length !== width * height ? `the mask has not ${width * height} values` : null);
    const copy = { test: test.slice(), reference: reference.slice(), mask: mask?.slice() };
    return this.#ask({ type: "compare", ...copy, width, height }, [copy.test.buffer, copy.reference.buffer]);
  }

  async study({ seed = 1, size = 512, scenes = 50, truth = 4096 } = {}, { signal, progress, scene } = {}) {
    const records = [];
    const part = (record) => {
      records.push(record);
      scene?.(record, records.length - 1);
    };
    const correlations = await this.#ask({ type: "study", seed, size, scenes, truth }, [], { signal, progress, part });
    return { records, correlations };
  }
}

async function planOf({ build = "auto", threads }) {
  const simd = hasSimd(), shared = simd && hasSharedMemory();
  if (build === "simd128" && !simd) throw new DappleError("unavailable", "there is no simd128 here");
  if (build === "threads" && !shared) throw new DappleError("unavailable", "there is no shared memory here");
  const wanted = Math.min(Math.max(threads ?? (await processors()), 1), MAX_THREADS);
  const crew = build === "threads" || (build === "auto" && shared && wanted > 1);
  const chosen = crew ? "threads" : build !== "auto" ? build : simd ? "simd128" : "scalar";
  return { build: chosen, threads: crew ? wanted : 1 };
}

/** Opens the CPU back end; see index.d.ts. */
export async function openWasm(options = {}) {
  const { build, threads } = await planOf(options);
  const stopFlag = hasSharedMemory() ? new SharedArrayBuffer(4) : null;
  const module = await loadModule(build);
  const plan = { module, shared: build === "threads", helpers: threads - 1, stopFlag };
  const backend = new WasmBackend(plan, build, threads);
  try {
    return await backend.start();
  } catch (error) {
    // Phones may have shared memory and no room for as much: one thread always works.
    if (build !== "threads" || options.build === "threads") throw error;
    return openWasm({ ...options, build: "simd128" });
  }
}
