// The worker that solves: one request at a time, answered by a session. Started by crew.js.
import { Core, DappleError } from "./core.js";
import { workerPort } from "./port.js";
import { Session } from "./session.js";

const PROGRESS_EVERY_MS = 40;
const STACK_BYTES = 256 * 1024; // of a helper

const port = await workerPort();
let session = null;
let stop = null; // Int32Array in shared memory: not 0 when the request at hand is to end
let request = 0;
let told = 0;
let record = {};

const host = {
  progress(done) {
    const now = performance.now();
    if (done >= 0 && now - told >= PROGRESS_EVERY_MS) {
      told = now;
      port.post({ id: request, progress: done });
    }
    return !stop || Atomics.load(stop, 0) === 0;
  },
  number(name, value) {
    record[name] = value;
  },
};

const answers = {
  async open({ module, memory, helpers, stopFlag }) {
    const core = await Core.start(module, memory, host);
    session = new Session(core, helpers);
    stop = stopFlag && new Int32Array(stopFlag);
    return { isa: session.isa, families: session.families(), crew: session.crew(helpers, STACK_BYTES) };
  },
  solve: ({ world, settings, watched }) => session.solve(world, settings, watched),
  scene: ({ family, seed, index, width, height }) => session.scene(family, seed, index, width, height),
  compare: ({ test, reference, width, height, mask }) => session.compare(test, reference, width, height, mask),
  distance: ({ world }) => session.distance(world),
  shadows: ({ world, lights, method }) => session.shadows(world, lights, method),
  flood: ({ world, settings }) => session.flood(world, settings),
  study(message) {
    const takeRecord = () => {
      const taken = record;
      record = {};
      return taken;
    };
    const run = session.study(message, takeRecord);
    for (;;) {
      const { done, value } = run.next();
      if (done) return value;
      port.post({ id: request, part: value });
    }
  },
};

/** Buffers of an answer, to be handed over and not copied. */
function buffersOf(value) {
  if (ArrayBuffer.isView(value)) return [value.buffer];
  if (value === null || typeof value !== "object") return [];
  return Object.values(value).flatMap((v) => (ArrayBuffer.isView(v) ? [v.buffer] : []));
}

port.listen(async (message) => {
  request = message.id;
  told = performance.now();
  try {
    const value = await answers[message.type](message);
    port.post({ id: request, value }, buffersOf(value));
  } catch (error) {
    // A trap leaves the module in no state to go on with.
    const fatal = error instanceof WebAssembly.RuntimeError;
    const code = error instanceof DappleError ? error.code : "failed";
    port.post({ id: request, error: { code, message: error.message, fatal } });
  }
});
port.post({ ready: true });
