/**
 * What every back end of the web package is: planes of a pixel world go in, mean radiance comes out. The
 * page and games talk to this alone; `wasm` and `webgpu` implement it.
 *
 * All planes are row by row from the top left, three floats per pixel: length width * height * 3.
 */

/** A pixel world. */
export interface World {
  width: number;
  height: number;
  /** Linear RGB radiance >= 0. */
  emission: Float32Array;
  /** RGB extinction per pixel [1/px], >= 0; Infinity is opaque. */
  extinction: Float32Array;
  /** RGB albedo of opaque pixels, 0 .. 1; absent: black walls. Needed for bounces only. */
  albedo?: Float32Array;
  /** RGB radiance of rays that leave the world; absent: black. */
  sky?: readonly [number, number, number];
}

export type SolverName = "holographic" | "cascades" | "reference";

/** The ARC paper's ladder (off, L5 .. L2, auto), and the two that keep a promise. */
export type SkipName = "off" | "L5" | "L4" | "L3" | "L2" | "auto" | "exact" | "bounded";

export type MergeName = "bilinear" | "bilinear-fix" | "nearest-fix";

/** How to light a world. What a solver does not know is ignored; defaults are those of the C library. */
export interface Settings {
  solver?: SolverName;
  /** holographic, reference: 0 .. 8, default 0 */
  bounces?: number;
  /** cascades, default "bilinear-fix" */
  merge?: MergeName;
  /** cascades, default "off" */
  skip?: SkipName;
  /** cascades with "bounded": the error that is allowed [dB], default 50 */
  boundDb?: number;
  /** reference: rays per pixel, default 4096 */
  directions?: number;
  /** For frames of which each is much like the last: wasm keeps the last one and solves what has changed, where there
   * is memory for that. The light has the same bits. Default false */
  reuse?: boolean;
}

/** One level of cascades. */
export interface LevelStats {
  probes: number;
  directions: number;
  raysFull: number;
  raysTraced: number;
}

/** What skipping saw and did. */
export interface SkipStats {
  /** The paper's signals by name, 0 .. 1; empty when none was measured. */
  signals: Record<string, number>;
  /** The paper's score of them, or null. */
  score: number | null;
  /** The rung that was used: "off", "L5" … or "exact", "bounded". */
  chosen: SkipName;
}

/** One stage of a solve, in order. */
export interface Stage {
  name: string;
  ms: number;
}

export interface Stats {
  levels: LevelStats[];
  raysFull: number;
  raysTraced: number;
  skip: SkipStats | null;
  stages: Stage[];
}

export interface Solution {
  width: number;
  height: number;
  /** Mean radiance, linear RGB; opaque pixels show their emission. */
  light: Float32Array;
  stats: Stats;
}

export interface SolveOptions {
  /** Cancels: the promise is rejected with the signal's reason. */
  signal?: AbortSignal;
  /** Told now and then how far a long solve has come, 0 .. 1. */
  progress?: (done: number) => void;
}

export interface Backend {
  readonly name: "wasm" | "webgpu";
  /** For people: "wasm simd128, 2 threads", or the adapter's own words. */
  readonly detail: string;
  /** Null when these settings can be solved at this size; else one sentence that says why not. */
  refuses(settings: Settings, width: number, height: number): string | null;
  /** One at a time; a second call waits for the first. The world's planes are read before the promise is returned. */
  solve(world: World, settings?: Settings, options?: SolveOptions): Promise<Solution>;
  /** Settles when the back end is no more, with a sentence that says why: a lost device, a dead worker, close(). */
  readonly lost: Promise<string>;
  close(): void;
}
