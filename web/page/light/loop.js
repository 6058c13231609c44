// The frame loop: solves again when something changed, never two at once, and paints when there is something
// new to see. Called by main; it knows the drawing, the lantern and the screen.
import { lanternRadius, withLantern } from "../draw/lantern.js";
import { materialOf } from "../draw/materials.js";
import { lightOfLantern } from "./shadows.js";
import { solveAny } from "./ways.js";

/** How long the time between solves may be for them to count as one run of frames [ms]. */
const PAUSE = 500;
/** Frames that the rate is the mean of. */
const FRAMES = 20;
/** Nobody sees more pictures than one in so long [ms]. */
const FRAME = 1000 / 60;

export class Loop extends EventTarget {
  #parts;
  #solveWanted = false;
  #paintWanted = false;
  #asked = false;
  #running = null;
  #times = [];
  #begun = 0;
  /** The last solution with how it came about, or null: { solution, backend, instead, lantern, ms,
   * paintMs, rate }. */
  last = null;

  /** parts: { drawing, settings, backends, screen, lanternAt(now), wanders(), truth() }; lanternAt gives a place or
   * null, wanders() whether that changes by itself. */
  constructor(parts) {
    super();
    this.#parts = parts;
  }

  /** The world, or how to solve it, changed. */
  solve() {
    this.#solveWanted = true;
    this.paint();
  }

  /** Like solve(), and what is being solved now is of no use any more. */
  restart() {
    this.#running?.abort();
    this.solve();
  }

  /** Only the way of looking changed. */
  paint() {
    this.#paintWanted = true;
    this.#ask();
  }

  /** Is anything still to be solved or painted? Told by "busy" events. */
  get busy() {
    return this.#asked || this.#solveWanted || this.#running !== null;
  }

  #ask() {
    if (this.#asked) return;
    this.#asked = true;
    this.dispatchEvent(new Event("busy"));
    requestAnimationFrame((now) => {
      this.#asked = false;
      this.#frame(now);
    });
  }

  #frame(now) {
    const wanders = this.#parts.wanders();
    if (wanders) this.#solveWanted = true;
    if (this.#solveWanted && !this.#running) this.#begin(now);
    if (this.#paintWanted) this.#paint();
    if (wanders) this.#ask();
    this.dispatchEvent(new Event("busy"));
  }

  /** A copy of the world as it is lit now, the lantern in it. */
  litWorld() {
    return this.#withLantern(this.last?.lantern, () => this.#parts.drawing.world.copy());
  }

  /** The lights of the world, the lantern among them. */
  litLights() {
    return this.#lights(this.last?.lantern);
  }

  #lights(at) {
    const { drawing, settings } = this.#parts,
      brush = settings.brush();
    const carried = at ? [lightOfLantern(at, materialOf(brush), lanternRadius(brush))] : [];
    return [...drawing.world.lights, ...carried];
  }

  /** For shadows the lantern is a light that blocks nothing, else an opaque lamp in the world. */
  #withLantern(at, action) {
    const { drawing, settings } = this.#parts;
    const stamped = at && settings.get("solver") !== "shadows";
    return stamped ? withLantern(drawing.world, at, settings.brush(), action) : action();
  }

  #paint() {
    const { drawing, settings, screen, truth } = this.#parts;
    this.#paintWanted = false;
    const { world } = drawing;
    const fits = this.last?.solution.width === world.width && this.last.solution.height === world.height;
    const seen = fits ? this.last.solution.seen : null;
    const frame = {
      // A method that sees something else than the drawing shows that.
      world: seen ? Object.assign(Object.create(world), seen) : world,
      light: fits ? this.last.solution.light : null,
      side: fits ? (this.last.solution.side ?? 0) : 0,
      truth: truth(),
      exposure: settings.get("exposure"),
      bounced: (settings.solve().bounces ?? 0) > 0,
    };
    // The lantern where it shone from: its disc and its light belong together.
    const ms = this.#withLantern(this.last?.lantern, () => screen.paint(settings.get("view"), frame));
    if (this.last) this.last.paintMs = ms;
    this.dispatchEvent(new Event("painted"));
  }

  #begin(now) {
    const running = new AbortController();
    this.#running = running;
    this.#solveWanted = false;
    this.#begun = now;
    this.#run(now, running)
      .catch((error) => this.#failed(error, running))
      .finally(() => {
        this.#running = null;
        this.#goOn();
        this.dispatchEvent(new Event("busy"));
      });
  }

  /** Begins what was asked for meanwhile: at once where a frame's time has gone by, so that nobody waits for the
   * next frame and painting goes on beside it. */
  #goOn() {
    const now = performance.now();
    this.#solveWanted ||= this.#parts.wanders();
    if (!this.#solveWanted) return;
    if (now - this.#begun >= FRAME && !document.hidden) this.#begin(now);
    else this.#ask();
  }

  async #run(now, running) {
    const { drawing, settings, backends } = this.#parts;
    const begin = performance.now();
    // From frame to frame little changes: a back end that can make use of that may.
    const asked = { ...settings.solve(), reuse: true },
      { world } = drawing;
    const { backend, instead } = await backends.choose(settings.get("backend"), asked, world.width, world.height);
    const options = {
      signal: running.signal,
      progress: (done) =>
        this.dispatchEvent(new CustomEvent("progress", { detail: { done, ms: performance.now() - begin } })),
    };
    const lantern = this.#parts.lanternAt(now);
    // A back end reads the planes before solve() returns: the lantern need not stay for longer.
    const lights = this.#lights(lantern);
    const solution = await this.#withLantern(lantern, () => solveAny(backend, world, asked, lights, options));
    this.#solved({ solution, backend, instead, lantern }, begin);
  }

  #solved(result, begin) {
    const now = performance.now();
    this.#times = this.#times.filter((_, i, all) => now - all[all.length - 1] < PAUSE).slice(-FRAMES);
    this.#times.push(now);
    const frames = this.#times.length - 1;
    const rate = frames > 0 ? (1000 * frames) / (now - this.#times[0]) : null;
    this.last = { ...result, ms: now - begin, paintMs: this.last?.paintMs ?? 0, rate };
    this.paint();
    this.dispatchEvent(new Event("solved"));
  }

  #failed(error, running) {
    if (running.signal.aborted) return;
    this.dispatchEvent(new CustomEvent("failed", { detail: error }));
  }
}
