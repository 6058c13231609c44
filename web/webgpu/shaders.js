/** The text of the kernels: which parts each is put together from, and where parts come from. Used by kit.js. */

/** Where the package has them. */
const DEFAULT_FOLDER = new URL("../shaders/", import.meta.url);

/** Parts of a kernel in order, each a file `shaders/NAME.wgsl`; the last one has its entry points. */
const KERNELS = {
  distance: ["item", "distance"],
  near: ["item", "near"],
  grid: ["item", "grid"],
  clear: ["item", "rows", "exponential", "march", "skip", "aim", "level", "clear"],
  trace: ["item", "rows", "exponential", "march", "skip", "aim", "level", "trace"],
  choose: ["item", "rows", "exponential", "march", "choose"],
  pixels: ["item", "rows", "pixels"],
  mark: ["item", "picture", "sets", "mark"],
  list: ["item", "picture", "sets", "listed", "list"],
  look: ["item", "picture", "sets", "listed", "look"],
  mean: ["rows", "picture", "mean"],
  finish: ["item", "rows", "picture", "light", "finish"],
  rims: ["item", "rows", "picture", "light", "listed", "rims"],
};

/** Kernels of holographic cascades exist by what an interval is and what a segment keeps of its way. */
const WORLDS = { hard: "grey", grey: "grey", rgb: "rgb" };
for (const [world, interval] of Object.entries(WORLDS)) {
  const shape = `interval_${interval}`;
  const before = [shape, "rows", "quadrant", "blocks"];
  const taps = ["taps", world === "hard" ? "trail_hard" : "trail_media"];
  if (world !== "hard") KERNELS[`world_${world}`] = ["item", shape, "rows", "exponential", "world"];
  KERNELS[`strip_${world}`] = [...before, ...taps, `keep_${interval}`, "strip"];
  KERNELS[`column_${world}`] = [...before, `keep_${interval}`, "column"];
  KERNELS[`merge_${world}`] = [...before, "beyond", "merge"];
  KERNELS[`gather_${world}`] = [...before, ...taps, "beyond", "gather"];
}

async function fetchText(url) {
  const answer = await fetch(url);
  if (!answer.ok) throw new Error(`${url}: ${answer.status} ${answer.statusText}`);
  return answer.text();
}

export class ShaderLibrary {
  #folder;
  #parts = new Map();

  /** @param {string | URL} [folder] that holds the WGSL files, ends in "/"; default: the package's own */
  constructor(folder = DEFAULT_FOLDER) {
    this.#folder = new URL(folder, globalThis.location?.href);
  }

  /** The names of all kernels. */
  static get kernels() {
    return Object.keys(KERNELS);
  }

  #part(name) {
    if (!this.#parts.has(name)) this.#parts.set(name, fetchText(new URL(`${name}.wgsl`, this.#folder)));
    return this.#parts.get(name);
  }

  /** The WGSL text of a kernel. */
  async kernel(name) {
    const parts = await Promise.all(KERNELS[name].map((part) => this.#part(part)));
    return parts.join("\n");
  }
}
