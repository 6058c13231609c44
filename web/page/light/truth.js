// The truth of the picture, by the reference solver in a worker of its own: slow, with progress, and gone when
// the drawing changes. Called by main for the difference view.
import { openWasm, compare } from "./package.js";

export class Truth extends EventTarget {
  #backend = null;
  #running = null;
  /** "none", "running", "done", "cancelled" or "failed". */
  state = "none";
  done = 0;
  /** Mean radiance of the truth, or null. */
  light = null;
  error = "";

  /** Begins anew; `world` is copied. */
  async start(world, settings) {
    this.#stop();
    const running = new AbortController();
    this.#running = running;
    this.#tell("running", 0);
    try {
      this.#backend ??= openWasm();
      const backend = await this.#backend;
      const solution = await backend.solve(world, settings, {
        signal: running.signal,
        progress: (done) => this.#running === running && this.#tell("running", done),
      });
      if (this.#running !== running) return;
      this.light = solution.light;
      this.world = world;
      this.#tell("done", 1);
    } catch (error) {
      if (running.signal.aborted || this.#running !== running) return;
      this.#backend = null;
      this.error = error.message;
      this.#tell("failed", 0);
    }
  }

  cancel() {
    this.#stop();
    this.#tell("cancelled", 0);
  }

  /** The drawing is another one now. */
  forget() {
    if (this.state === "none") return;
    this.#stop();
    this.#tell("none", 0);
  }

  /** How far `light` is from the truth: the library's figures, or null while there is none. */
  judge(light) {
    return this.light && this.light.length === light.length ? compare(light, this.light, this.world) : null;
  }

  #stop() {
    this.#running?.abort();
    this.#running = null;
    this.light = null;
  }

  #tell(state, done) {
    this.state = state;
    this.done = done;
    this.dispatchEvent(new Event("change"));
  }
}
