// One instance of the WebAssembly module: memory, strings, and calls that throw. Used by worker.js and helper.js
// inside workers; nothing here touches a page.

/** An error of the library. `code`: argument, desc, memory, size, unavailable, thread, cancelled or failed. */
export class DappleError extends Error {
  constructor(code, message) {
    super(message);
    this.name = "DappleError";
    this.code = code;
  }
}

// Order of dpl_status.
const STATUS = ["ok", "argument", "desc", "memory", "size", "unavailable", "thread", "cancelled"];

// The C library's files: there are none.
const NO_FILES = 8; // EBADF
const wasi_snapshot_preview1 = { fd_close: () => NO_FILES, fd_seek: () => NO_FILES, fd_write: () => NO_FILES };

const decoder = new TextDecoder();

export class Core {
  /**
   * Starts an instance.
   * @param module  compiled WebAssembly.Module
   * @param memory  shared memory of a crew, or null
   * @param host    { progress(done) -> boolean, number(name, value) }
   * @param first   false for helpers: the memory is set up already
   */
  static async start(module, memory, host, first = true) {
    const core = new Core();
    const place = (address) => ((address >>> 0) / 4) | 0;
    const env = {
      dpl_web_now: () => performance.now(),
      dpl_web_progress: (done) => (host.progress(done) ? 1 : 0),
      dpl_web_report: (text) => (core.reported = core.text(text)),
      dpl_web_number: (where, name, value) => host.number(core.text(where) + core.text(name), value),
      dpl_web_wait: (address, value) => core.wait(place(address), value),
      dpl_web_wake: (address) => core.wake(place(address)),
    };
    if (memory) env.memory = memory;
    const instance = await WebAssembly.instantiate(module, { env, wasi_snapshot_preview1 });
    core.call = instance.exports;
    core.memory = memory ?? instance.exports.memory;
    core.reported = "";
    if (first) core.call._initialize();
    return core;
  }

  wait(place, value) {
    Atomics.wait(new Int32Array(this.memory.buffer), place, value);
  }

  wake(place) {
    if (this.memory.buffer instanceof ArrayBuffer) return; // nobody else is in this memory
    Atomics.notify(new Int32Array(this.memory.buffer), place);
  }

  bytes(address, length) {
    return new Uint8Array(this.memory.buffer, address >>> 0, length);
  }

  floats(address, length) {
    return new Float32Array(this.memory.buffer, address >>> 0, length);
  }

  doubles(address, length) {
    return new Float64Array(this.memory.buffer, address >>> 0, length);
  }

  text(address) {
    const bytes = new Uint8Array(this.memory.buffer, address >>> 0);
    return decoder.decode(bytes.slice(0, bytes.indexOf(0))); // a copy: no text is read from shared memory
  }

  /** Calls `use(address)` with `bytes` bytes of memory that are given back afterwards. */
  withBytes(bytes, use) {
    const address = this.call.malloc(Math.max(bytes, 8));
    if (!address) throw new DappleError("memory", `no memory for ${bytes} bytes`);
    try {
      return use(address);
    } finally {
      this.call.free(address);
    }
  }

  /** Throws unless a function of the module has succeeded. */
  check(status, session) {
    if (status === 0) return;
    throw new DappleError(STATUS[status] ?? "failed", this.text(this.call.dpl_web_message(session, status)));
  }

  /** The same for those that return 1 for success and report what failed; a stop reports nothing. */
  checkReported(good) {
    if (good) return;
    const reported = this.reported;
    this.reported = "";
    throw reported ? new DappleError("failed", reported) : new DappleError("cancelled", "cancelled");
  }
}
