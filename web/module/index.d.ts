/**
 * Dapple in JavaScript: light for pixel worlds by the C library as WebAssembly, in browsers and in node. Works
 * are done in workers, one after another; planes are as in backend.d.ts.
 */
import type { Backend, Solution, World } from "./backend.js";
export type * from "./backend.js";

/** An error of the library, with its sentence as the message. */
export class DappleError extends Error {
  readonly code: "argument" | "desc" | "memory" | "size" | "unavailable" | "thread" | "cancelled" | "failed";
}

export interface WasmOptions {
  /** "auto" (default): threads where memory can be shared, else simd128 where there is such, else scalar. */
  build?: "auto" | "scalar" | "simd128" | "threads";
  /** Of the build "threads", 1 .. 16; default: as many as there are processors. The light is the same for any. */
  threads?: number;
}

/** A disc of light for shadows: radiance color * intensity. */
export interface Light {
  /** Centre [px]. */
  position: readonly [number, number];
  /** [px] */
  radius: number;
  /** Linear RGB. */
  color: readonly [number, number, number];
  intensity: number;
}

/** A world of tiles: walls and lights stand in cells, row by row from the top left. */
export interface TileWorld {
  width: number;
  height: number;
  /** 1: a wall, 0: air. */
  walls: Uint8Array;
  /** Linear RGB >= 0 of the light that stands in a cell, three values per cell; a wall may hold one. */
  lights: Float32Array;
}

export interface FloodSettings {
  /** Default "round": nearly round light that keeps its hue; "multiplicative" does so in diamonds. "euclidean" and
   * "subtractive" lose an amount with each step instead of a share. */
  falloff?: "round" | "multiplicative" | "euclidean" | "subtractive";
  /** How many cells far the brightest light reaches, 1 .. 4096, default 16. */
  range?: number;
}

/** Light of a tile world. Counts are of this call: after a small change few cells are visited. */
export interface FloodSolution {
  width: number;
  height: number;
  /** Linear RGB, three values per cell. */
  light: Float32Array;
  stats: { visits: number; pushes: number; removals: number; fromScratch: boolean; ms: number };
}

/** A generated world; its lights are for shadows(). */
export interface Scene extends World {
  albedo: Float32Array;
  sky: [number, number, number];
  lights: Light[];
}

/** How far two pictures are apart. */
export interface Comparison {
  /** [dB], peak 1; Infinity when they are the same. */
  psnrLinear: number;
  /** [dB], after the tone map, 8 bits. */
  psnrDisplay: number;
  /** rms error / mean of the reference. */
  relRmse: number;
  ssim: number;
  flip: number;
  /** How many pixels were compared. */
  pixels: number;
}

export interface WorkOptions {
  signal?: AbortSignal;
  progress?: (done: number) => void;
}

export interface StudyPlan {
  /** Default 1. */
  seed?: number | bigint;
  /** Of each scene, 64 .. 4096 [px], default 512. */
  size?: number;
  /** The first so many of the 50, default 50. */
  scenes?: number;
  /** Free pixels per scene that the truth is traced at, 1 .. 16384, default 4096. */
  truth?: number;
}

/**
 * The numbers of one scene by name: seed, index, lights, occluders, truth_pixels; "paper.levels",
 * "paper.signals.mean" …; "paper.L4.traced", "paper.L4.display_off" …; the same for "corrected". What each
 * means: tools/dapple/study/record.h.
 */
export type StudyRecord = Record<string, number>;

/** Pearson's r of a signal with the quality of L2 against off, with its 95 % interval. */
export interface StudyCorrelation {
  profile: "paper" | "corrected";
  signal: string;
  quality: "psnr_display" | "psnr_linear";
  r: number;
  low: number;
  high: number;
  p: number;
  count: number;
}

export interface Study {
  records: StudyRecord[];
  correlations: StudyCorrelation[];
}

export interface WasmBackend extends Backend {
  readonly name: "wasm";
  readonly build: "scalar" | "simd128" | "threads";
  readonly threads: number;
  /** Scene families, and how many scenes each has per seed. */
  readonly families: readonly { name: string; count: number }[];

  /**
   * A scene of a family. It is laid out on a square of the larger side and cut to its top left part. Rejects for
   * "offscreen", whose world is larger than its picture.
   */
  makeScene(family: string, seed: number | bigint, index: number, width: number, height?: number): Promise<Scene>;

  /** Judges `test` by `reference`, linear RGB both. Pixels where `mask` is not 0 are left out. */
  compare(test: Float32Array, reference: Float32Array, width: number, height: number,
    mask?: Uint8Array): Promise<Comparison>;

  /** Distance of each pixel to the nearest that is not empty [px], length width * height. */
  distance(world: World, options?: WorkOptions): Promise<Float32Array>;

  /** The light of discs with soft shadows of opaque pixels, linear RGB; add it to what solve() gives. */
  shadows(world: World, lights: readonly Light[],
    options?: WorkOptions & { method?: "rays" | "exact" | "mrma" | "reference" }): Promise<Float32Array>;

  /** Lights tiles by flood fill. The last world is kept: with the same size and settings, only what its changes touch
   * is worked out again, to the same light. */
  flood(world: TileWorld, settings?: FloodSettings, options?: WorkOptions): Promise<FloodSolution>;

  /** The ARC paper's scenes, as `dapple study` runs them; `scene` is told of each as it is done. */
  study(plan?: StudyPlan,
    options?: WorkOptions & { scene?: (record: StudyRecord, index: number) => void }): Promise<Study>;
}

/** Opens the CPU back end. */
export function openWasm(options?: WasmOptions): Promise<WasmBackend>;

/** results.csv of `dapple study`: a row for each scene, profile and mode. */
export function studyTable(records: readonly StudyRecord[]): string;

/**
 * 8-bit RGBA for ImageData: v = 1 - 1/(1 + 2 pi m)^2.5 per channel, m the mean radiance times `exposure`
 * (default 1), as the library's own tone map to the byte.
 */
export function tonemap(light: Solution["light"], exposure?: number): Uint8ClampedArray;
