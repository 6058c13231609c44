// The truth of the picture, by the reference solver in a worker of its own: slow, with progress, and gone when
// the drawing changes. Called by main for the difference view.
import { openWasm } from "./package.js";
import { solveAny } from "./ways.js";

export class Truth extends EventTarget {
  #backend = null;
  #running = null;
  /** "none", "running", "done", "cancelled" or "failed". */
  state = "none";
  done = 0;
  /** Mean radiance of the truth, or null. */
  light = null;
  error = "";
  /** The world it is the truth of. */
  world = null;
  /** Its rays per pixel. */
  directions = 0;

  /** Begins anew; nobody may change `world` afterwards. `lights` are for shadows. */
  async start(world, settings, lights) {
    this.#stop();
    const running = new AbortController();
    this.#running = running;
    this.#tell("running", 0);
    try {
      this.#backend ??= openWasm();
      const backend = await this.#backend;
      const solution = await solveAny(backend, world, settings, lights, {
        signal: running.signal,
        progress: (done) => this.#running === running && this.#tell("running", done),
      });
      if (this.#running !== running) return;
      this.light = solution.light;
      this.world = world;
      this.directions = settings.directions ?? Infinity;
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

  /** How far `light` is from the truth, opaque pixels left out: the library's figures, or null. */
  async judge(light) {
    const { light: reference, world } = this;
    if (!reference || reference.length !== light.length) return null;
    const opaque = Uint8Array.from({ length: world.width * world.height }, (_, pixel) => Number(world.isOpaque(pixel)));
    const backend = await this.#backend;
    return backend.compare(light, reference, world.width, world.height, opaque);
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
