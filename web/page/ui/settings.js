// What people chose, and the part of it that goes into the address so that a link shows the same scene the same
// way. Called by nearly everything; controls.js binds it to the form.

const choice = (start, values) => ({ start, read: (text) => (values.includes(text) ? text : undefined) });
const text = (start, pattern) => ({ start, read: (given) => (pattern.test(given) ? given : undefined) });
const flag = (start) => ({ start, read: (given) => ({ true: true, false: false })[String(given)] });
const number = (start, least, most) => ({
  start,
  read: (given) => {
    const value = Number(given);
    return given !== "" && value >= least && value <= most ? value : undefined;
  },
});

/** Solvers whose light bounces. */
const BOUNCING = ["holographic", "reference"];

/** In the address where they differ from `start`. */
const SHARED = {
  scene: text("house", /^[a-z]+$/),
  seed: number(1, 0, 999999),
  index: number(0, 0, 49),
  size: number(256, 16, 1024),
  backend: choice("wasm", ["wasm", "webgpu"]),
  solver: choice("holographic", ["holographic", "cascades", "reference", "shadows", "flood"]),
  bounces: number(0, 0, 8),
  merge: choice("bilinear-fix", ["bilinear", "bilinear-fix", "nearest-fix"]),
  skip: choice("off", ["off", "L5", "L4", "L3", "L2", "auto", "exact", "bounded"]),
  shadow: choice("exact", ["exact", "rays", "mrma"]),
  cell: choice("4", ["4", "8", "16"]),
  falloff: choice("round", ["round", "multiplicative", "euclidean", "subtractive"]),
  range: number(24, 1, 64),
  bound: number(50, 20, 90),
  rays: number(64, 16, 4096),
  view: choice("light", ["light", "lit", "emission", "walls", "difference"]),
  exposure: number(0, -4, 4),
  truth: number(256, 64, 4096),
  sky: text("", /^(#[0-9a-f]{6})?$/),
};

/** Of this visit alone. */
const OWN = {
  tool: choice("carry", ["brush", "line", "rectangle", "circle", "carry"]),
  material: choice("lamp", ["lamp", "wall", "glass", "fog", "eraser"]),
  colour: text("#ffb35c", /^#[0-9a-f]{6}$/),
  radius: number(8, 1, 64),
  brightness: number(3, 0.1, 20),
  density: number(1, 0.1, 5),
  filled: flag(false),
  wander: flag(false),
};

const ALL = { ...SHARED, ...OWN };

export class Settings extends EventTarget {
  #values = Object.fromEntries(Object.entries(ALL).map(([name, rule]) => [name, rule.start]));

  get(name) {
    return this.#values[name];
  }

  /** Takes a value if it is allowed; says so to listeners of "change" (detail: the name). */
  set(name, given) {
    const value = ALL[name].read(given);
    if (value === undefined || value === this.#values[name]) return;
    this.#values[name] = value;
    this.dispatchEvent(new CustomEvent("change", { detail: name }));
  }

  /** Everything that differs from the start, as the part of an address behind "#". */
  address() {
    const changed = Object.keys(SHARED).filter((name) => this.#values[name] !== SHARED[name].start);
    return new URLSearchParams(changed.map((name) => [name, this.#values[name]])).toString();
  }

  /** Takes what an address says; what it does not name goes back to the start. */
  readAddress(hash) {
    const given = new URLSearchParams(hash.replace(/^#/, ""));
    for (const name of Object.keys(SHARED)) this.set(name, given.get(name) ?? SHARED[name].start);
  }

  isShared(name) {
    return name in SHARED;
  }

  /** The brush as pen and lantern read it; sizes grow with the picture, so that a stroke keeps its look. */
  brush() {
    const { tool, colour, brightness, density, filled } = this.#values;
    const material = tool === "carry" ? "lamp" : this.#values.material;
    return { tool, material, colour, brightness, density, filled, size: this.brushSize() };
  }

  brushSize() {
    return (this.#values.radius * this.#values.size) / 256;
  }

  /** What a back end is asked for. */
  solve() {
    const { solver, bounces, merge, skip, bound, rays, shadow, cell, falloff, range } = this.#values;
    return {
      holographic: { solver, bounces },
      cascades: { solver, merge, skip, ...(skip === "bounded" ? { boundDb: bound } : {}) },
      reference: { solver, bounces, directions: rays },
      shadows: { solver, method: shadow },
      flood: { solver, cell: Number(cell), falloff, range },
    }[solver];
  }

  /** What the truth of that is asked for. */
  solveTruth() {
    const { solver, bounces, truth } = this.#values;
    if (solver === "shadows") return { solver, method: "reference" };
    return { solver: "reference", bounces: BOUNCING.includes(solver) ? bounces : 0, directions: truth };
  }
}
