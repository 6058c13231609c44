// The workers of a back end: one that solves, and helpers where memory is shared. Used by wasm.js, which
// hands it one request at a time and makes a new crew when it has to end one.
import { sharedMemory } from "./build.js";
import { DappleError } from "./core.js";
import { spawn } from "./port.js";

const workerUrl = new URL("./worker.js", import.meta.url);
const helperUrl = new URL("./helper.js", import.meta.url);

export class Crew {
  /**
   * Starts the workers.
   * @param plan  { module, shared, helpers, stopFlag }; `shared`: the module is the one with threads
   * @param lost  called once with a sentence when a worker dies on its own
   */
  static async start(plan, lost) {
    const crew = new Crew();
    crew.workers = [];
    crew.pending = null;
    crew.nextId = 1;
    crew.over = false;
    crew.lost = lost;
    try {
      await crew.startAll(plan);
    } catch (error) {
      crew.end();
      throw error;
    }
    return crew;
  }

  async startAll({ module, shared, helpers, stopFlag }) {
    const memory = shared ? sharedMemory() : null;
    if (shared && !memory) throw new DappleError("memory", "there is no room for shared memory");
    this.solver = await this.startWorker(workerUrl, "ready", (message) => this.receive(message));
    this.opened = await this.ask({ type: "open", module, memory, helpers, stopFlag });
    const { address, stacks } = this.opened.crew;
    await Promise.all(stacks.map(async (stack, i) => {
      let begun;
      const running = new Promise((resolve) => (begun = resolve));
      const helper = await this.startWorker(helperUrl, "ready", (message) => message.started && begun());
      helper.post({ module, memory, address, stack, worker: i + 1 });
      await running;
      helper.hold(false);
    }));
  }

  /** Settles when the worker has said `word`; later messages go to `handler`. */
  async startWorker(url, word, handler) {
    let settle;
    const ready = new Promise((resolve, reject) => (settle = { resolve, reject }));
    const failed = (text) => {
      settle.reject(new DappleError("failed", text));
      this.die(text);
    };
    const worker = await spawn(url, (message) => (message[word] ? settle.resolve() : handler(message)), failed);
    this.workers.push(worker);
    await ready;
    return worker;
  }

  /** Sends a request; `heard` gets its { progress } and { part } messages. */
  ask(message, transfer = [], heard = () => {}) {
    const id = this.nextId++;
    if (this.over) return Promise.reject(new DappleError("failed", "the back end was closed"));
    return new Promise((resolve, reject) => {
      this.pending = { id, resolve, reject, heard };
      this.solver.hold(true);
      this.solver.post({ ...message, id }, transfer);
    });
  }

  receive(message) {
    const pending = this.pending;
    if (!pending || message.id !== pending.id) return;
    if ("progress" in message || "part" in message) {
      pending.heard(message);
      return;
    }
    this.pending = null;
    this.solver.hold(false);
    if (!message.error) {
      pending.resolve(message.value);
      return;
    }
    pending.reject(new DappleError(message.error.code, message.error.message));
    if (message.error.fatal) this.die(`the module trapped: ${message.error.message}`);
  }

  /** A worker died on its own. */
  die(text) {
    if (this.over) return;
    this.end(text);
    this.lost(text);
  }

  /** Ends all workers; a request at hand is rejected. */
  end(text = "the back end was closed") {
    if (this.over) return;
    this.over = true;
    for (const worker of this.workers) worker.end();
    this.pending?.reject(new DappleError("failed", text));
    this.pending = null;
  }
}
