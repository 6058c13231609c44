/**
 * Holographic radiance cascades on the device: docs/algorithms/holographic.md. Called by index.js.
 *
 * Where the CPU goes strip by strip for its caches, a GPU goes level by level: T of all levels is kept for one quadrant
 * at a time, and R of two levels.
 */
import { weightsOf } from "./lens.js";
import { Plan, groupsFor, u32 } from "./plan.js";
import { WorldBuffers } from "./world.js";

/** Highest level that is traced through pixels. */
const TRACED_LEVEL = 2;

/** Kinds of chords through a pixel, where there are media. */
const CHORDS = 4;

const MEDIA = {
  none: { world: "hard", bytes: 16, chords: 1 },
  grey: { world: "grey", bytes: 16, chords: CHORDS },
  rgb: { world: "rgb", bytes: 32, chords: CHORDS },
};

export function refusal({ bounces = 0 }) {
  return bounces === 0 ? null : "bounces are not on WebGPU; the wasm back end has them";
}

/** One gather axis: columns along it, rows across. */
function axisOf(width, length, pixelSteps) {
  return { width, length, pixelSteps, levels: Math.ceil(Math.log2(width)) };
}

/** Along x and along y. */
function axesOf(width, height) {
  return [axisOf(width, height, [1, width]), axisOf(height, width, [width, 1])];
}

function columnsOf(axis, level) {
  return Math.ceil(axis.width / 2 ** level);
}

/** Segments of a level, from every pixel of its columns. */
function segmentsOf(axis, level) {
  return columnsOf(axis, level) * (2 ** level + 1) * axis.length;
}

function conesOf(axis, level) {
  return columnsOf(axis, level) * 2 ** level * axis.length;
}

function levelsOf(axis) {
  return Array.from({ length: axis.levels }, (_, level) => level);
}

/** The largest buffer [byte]. */
export function largestBuffer(width, height, media = "none") {
  const { bytes, chords } = MEDIA[media];
  const axes = axesOf(width, height);
  const segments = axes.flatMap((axis) =>
    levelsOf(axis)
      .slice(1)
      .map((level) => segmentsOf(axis, level)),
  );
  return bytes * Math.max(chords * width * height, ...segments);
}

/** What solves of the same key share. */
export function keyOf(world) {
  return `${world.width} ${world.height} ${world.media}`;
}

export class HolographicPlan {
  #kit;

  static async make(kit, world) {
    const made = new HolographicPlan();
    made.#kit = kit;
    made.plan = new Plan(kit);
    try {
      await made.#build(world);
    } catch (error) {
      made.destroy();
      throw error;
    }
    return made;
  }

  async #build({ width, height, media }) {
    const { plan } = this;
    this.media = MEDIA[media];
    this.axes = axesOf(width, height);
    this.world = new WorldBuffers(this.#kit, plan, width, height);
    this.levels = Math.max(...this.axes.map((axis) => axis.levels));
    this.light = plan.buffer("light", 12 * width * height);
    this.counters = plan.buffer("counters", 4 * (TRACED_LEVEL + 1));
    this.weights = plan.constant("weights", weightsOf(this.levels));
    this.cells = this.axes.map(() => plan.buffer("cells", this.media.bytes * this.media.chords * width * height));
    this.sums = this.axes.map(() => plan.buffer("sums", 16 * width * height));
    this.segments = Array.from({ length: this.levels }, (_, level) => this.#segmentBuffer(level));
    this.radiance = [0, 1].map((parity) => this.#radianceBuffer(parity));
    this.clearance = plan.buffer("clearance", 4 * width * height);
    this.steps = [...(await this.world.fieldSteps(this.clearance)), await this.#loadStep(width, height)];
    for (const axis of [0, 1])
      for (const mirrored of [0, 1]) this.steps.push(...(await this.#quadrantSteps(axis, mirrored)));
    this.steps.push(await this.#finishStep(width, height));
  }

  /** Shared by both axes, which take turns. Segments of level 0 are not kept. */
  #segmentBuffer(level) {
    if (level === 0) return null;
    const counts = this.axes.filter((axis) => level < axis.levels).map((axis) => segmentsOf(axis, level));
    return this.plan.buffer(`T${level}`, this.media.bytes * Math.max(...counts));
  }

  #radianceBuffer(parity) {
    const counts = this.axes.flatMap((axis) =>
      levelsOf(axis)
        .filter((level) => level % 2 === parity)
        .map((level) => conesOf(axis, level)),
    );
    return this.plan.buffer(`R${parity}`, 16 * Math.max(1, ...counts));
  }

  #kernel(name) {
    return `${name}_${this.media.world}`;
  }

  #loadStep(width, height) {
    const { size, emission, extinction } = this.world;
    return this.plan.step({
      stage: "field",
      kernel: this.#kernel("world"),
      entry: "load",
      constants: { CHORDS: this.media.chords },
      bindings: { 0: size, 1: emission, 2: extinction, 3: this.cells[0], 4: this.cells[1] },
      groups: groupsFor(width * height),
    });
  }

  #finishStep(width, height) {
    const { size, emission } = this.world;
    return this.plan.step({
      stage: "picture",
      kernel: "finish",
      entry: "show",
      bindings: { 0: size, 1: emission, 2: this.sums[0], 3: this.sums[1], 4: this.light },
      groups: groupsFor(width * height),
    });
  }

  async #quadrantSteps(axisIndex, mirrored) {
    const quadrant = { index: axisIndex, axis: this.axes[axisIndex], mirrored };
    const levels = levelsOf(quadrant.axis).slice(1);
    const steps = [];
    for (const level of levels.filter((n) => n <= TRACED_LEVEL))
      steps.push(...(await this.#traceSteps(quadrant, level)));
    for (const level of levels.slice(TRACED_LEVEL - 1, -1)) steps.push(await this.#extendStep(quadrant, level));
    for (const level of levels.toReversed()) steps.push(...(await this.#mergeSteps(quadrant, level)));
    steps.push(...(await this.#receiveSteps(quadrant)));
    return steps;
  }

  #uniform({ axis, mirrored }, level, first = 1, stride = 1) {
    const columns = [columnsOf(axis, level), columnsOf(axis, level + 1)];
    const place = [mirrored, first, stride, ...axis.pixelSteps];
    return this.plan.uniform("quadrant", u32(axis.width, axis.length, 2 ** level, ...columns, ...place));
  }

  /** Column 0 is never asked for, and of level 1 only odd ones are. */
  #traceSteps(quadrant, level) {
    const stride = level === 1 ? 2 : 1;
    const columns = columnsOf(quadrant.axis, level);
    const reach = 2 ** level;
    const rays = Array.from({ length: reach + 1 }, (_, k) => 2 * k - reach);
    return Promise.all(
      rays.map((rise) =>
        this.plan.step({
          stage: "trace",
          kernel: this.#kernel("strip"),
          entry: "trace",
          constants: { REACH: reach, RISE: rise },
          bindings: {
            0: this.#uniform(quadrant, level, 1, stride),
            1: this.cells[quadrant.index],
            2: this.clearance,
            3: this.counters,
            4: this.segments[level],
          },
          groups: [Math.ceil((columns - 1) / stride), 1, 1],
        }),
      ),
    );
  }

  /** T of level + 1. */
  #extendStep(quadrant, level) {
    return this.plan.step({
      stage: "extend",
      kernel: this.#kernel("column"),
      entry: "extend",
      bindings: { 0: this.#uniform(quadrant, level), 1: this.segments[level], 2: this.segments[level + 1] },
      groups: [2 ** level + 1, columnsOf(quadrant.axis, level + 1) - 1, 1],
    });
  }

  /** What merges of a level read of the one above. */
  #mergeBindings(level) {
    return { 5: this.radiance[(level + 1) % 2], 6: this.weights, 7: this.world.sky };
  }

  /** Odd columns, and even ones, which the level above has too. */
  #mergeSteps(quadrant, level) {
    const columns = columnsOf(quadrant.axis, level);
    const common = { stage: "merge", kernel: this.#kernel("column") };
    const bindings = {
      0: this.#uniform(quadrant, level),
      4: this.radiance[level % 2],
      ...this.#mergeBindings(level),
    };
    const odd = { ...bindings, 1: this.segments[level] };
    const even = { ...bindings, 3: this.segments[level + 1] };
    const steps = [{ ...common, entry: "merge_odd", bindings: odd, groups: [2 ** level, columns >> 1, 1] }];
    if (columns > 2)
      steps.push({ ...common, entry: "merge_even", bindings: even, groups: [2 ** level, (columns - 1) >> 1, 1] });
    return Promise.all(steps.map((step) => this.plan.step(step)));
  }

  /** Pixels before odd columns, and before even ones. */
  #receiveSteps(quadrant) {
    const { width } = quadrant.axis;
    const common = {
      stage: "gather",
      kernel: this.#kernel("gather"),
      constants: { MEDIA: Number(this.media.chords > 1), ADD: quadrant.mirrored },
      bindings: {
        0: this.#uniform(quadrant, 0),
        1: this.cells[quadrant.index],
        2: this.clearance,
        3: this.counters,
        4: this.sums[quadrant.index],
        ...this.#mergeBindings(0),
      },
    };
    const steps = [{ ...common, entry: "receive_odd", groups: [(width + 1) >> 1, 1, 1] }];
    if (width > 1) steps.push({ ...common, entry: "receive_even", groups: [width >> 1, 1, 1] });
    return Promise.all(steps.map((step) => this.plan.step(step)));
  }

  async solve(world) {
    this.world.upload(world);
    const reads = [
      { buffer: this.light, bytes: 12 * world.width * world.height },
      { buffer: this.counters, bytes: 4 * (TRACED_LEVEL + 1) },
    ];
    const { results, stages } = await this.plan.run(this.steps, { clears: [this.counters], reads });
    return {
      light: new Float32Array(results[0]),
      levels: this.#levelStats(new Uint32Array(results[1])),
      skip: null,
      stages: summed(stages),
    };
  }

  #levelStats(traced) {
    return Array.from({ length: this.levels }, (_, level) => {
      const axes = this.axes.filter((axis) => level < axis.levels);
      const probes = axes.reduce((sum, axis) => sum + columnsOf(axis, level) * axis.length, 0);
      return {
        probes,
        directions: 4 * 2 ** level,
        raysFull: 2 * probes * (2 ** level + 1),
        raysTraced: traced[level] ?? 0,
      };
    });
  }

  destroy() {
    this.plan.destroy();
  }
}

/** Stages of the same name as one. */
function summed(stages) {
  const sums = new Map();
  for (const { name, ms } of stages) sums.set(name, (sums.get(name) ?? 0) + ms);
  return [...sums].map(([name, ms]) => ({ name, ms }));
}
