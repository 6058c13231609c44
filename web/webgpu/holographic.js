/**
 * Holographic radiance cascades on the device: docs/algorithms/holographic.md. Called by index.js.
 *
 * Where the CPU goes strip by strip for its caches, a GPU goes level by level: T of all levels is kept for one quadrant
 * at a time, and R of two levels.
 */
import { weightsOf } from "./lens.js";
import { occupancyOf, wordsFor } from "./occupancy.js";
import { pictureSteps } from "./picture.js";
import { Plan, groupsFor, u32 } from "./plan.js";
import { WorldBuffers } from "./world.js";

/** Highest level that is traced through pixels. */
const TRACED_LEVEL = 2;

/** The level whose rays in between are partly traced, and how far those go across. */
const BETWEEN_LEVEL = 3;
const BETWEEN_RISES = [-6, -2, 2, 6];

/** Levels of which it is known where there is anything to trace, and which are counted. */
const NEAR_LEVELS = BETWEEN_LEVEL + 1;

/** Rows of a block, as shaders/quadrant.wgsl says; blocks of a word and of a window, as shaders/blocks.wgsl does. */
const BLOCK = 16;
const WORD = 32;
const WINDOW = 64;

/** Kinds of chords through a pixel, where there are media. */
const CHORDS = 4;

const MEDIA = {
  none: { world: "hard", bytes: 16, planes: 1, chords: 0 },
  grey: { world: "grey", bytes: 16, planes: 1, chords: CHORDS },
  rgb: { world: "rgb", bytes: 32, planes: 2, chords: CHORDS },
};

export function refusal({ bounces = 0 }) {
  return bounces === 0 ? null : "bounces are not on WebGPU; the wasm back end has them";
}

/** One gather axis: columns along it, rows across. */
function axisOf(width, length, pixelSteps) {
  const blocks = Math.ceil(length / BLOCK);
  const words = Math.ceil(blocks / WORD);
  return { width, length, pixelSteps, blocks, words, levels: Math.ceil(Math.log2(width)) };
}

/** Along x and along y. */
function axesOf(width, height) {
  return [axisOf(width, height, [1, width]), axisOf(height, width, [width, 1])];
}

function columnsOf(axis, level) {
  return Math.ceil(axis.width / 2 ** level);
}

/** Rays of all columns of a level. */
function raysOf(axis, level) {
  return columnsOf(axis, level) * (2 ** level + 1);
}

/** Straight rays in between of all columns. */
function betweenRaysOf(axis) {
  return axis.levels > BETWEEN_LEVEL ? BETWEEN_RISES.length * columnsOf(axis, BETWEEN_LEVEL) : 0;
}

/** Rays of all kept levels below this one. */
function raysBelow(axis, level) {
  return levelsOf(axis)
    .slice(1, level)
    .reduce((sum, below) => sum + raysOf(axis, below), 0);
}

function windowsFor(blocks) {
  return Math.ceil(blocks / WINDOW);
}

/** Cones of all columns. */
function conesOf(axis, level) {
  return columnsOf(axis, level) * 2 ** level;
}

function levelsOf(axis) {
  return Array.from({ length: axis.levels }, (_, level) => level);
}

/** The largest buffer [byte]. */
export function largestBuffer(width, height, media = "none") {
  const { bytes, chords } = MEDIA[media];
  return Math.max(bytes * chords, 16) * width * height;
}

/** The longest side of a texture [texel]. */
export function largestTexture(width, height, media = "none") {
  const rows = axesOf(width, height).flatMap((axis) =>
    levelsOf(axis)
      .slice(1)
      .map((level) => MEDIA[media].planes * raysOf(axis, level)),
  );
  return Math.max(width + 1, height + 1, ...rows);
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
    this.world = new WorldBuffers(this.#kit, plan, width, height, media !== "none");
    this.levels = Math.max(...this.axes.map((axis) => axis.levels));
    this.light = plan.buffer("light", 12 * width * height);
    this.counters = plan.buffer("counters", 4 * NEAR_LEVELS);
    this.listed = plan.buffer("listed pixels", 4);
    this.weights = plan.constant("weights", weightsOf(this.levels));
    if (this.media.chords > 0)
      this.cells = this.axes.map(() => plan.buffer("cells", this.media.bytes * this.media.chords * width * height));
    this.firstSums = this.#rowsTextures("sums", (axis) => axis.width);
    this.sums = this.axes.map((axis) => plan.texture("sums", axis.length + 1, axis.width));
    this.segments = Array.from({ length: this.levels }, (_, level) => this.#segmentTextures(level));
    const betweenRows = (axis) => Math.max(1, this.media.planes * betweenRaysOf(axis));
    this.between = this.#rowsTextures("T3 between", betweenRows);
    const words = this.axes.map((axis) => (raysBelow(axis, axis.levels) + betweenRaysOf(axis)) * axis.words);
    this.blocks = [0, 1, 2, 3].map(() => plan.buffer("blocks", 4 * Math.max(1, ...words))); // of a quadrant each
    this.radiance = [0, 1].map((parity) => this.#radianceTextures(parity));
    this.occupied = this.axes.map((axis) => plan.buffer("occupied", 4 * axis.width * wordsFor(axis.length)));
    this.steps = [];
    if (this.cells) this.steps.push(await this.#loadStep(width, height));
    for (const axis of [0, 1])
      for (const mirrored of [0, 1]) this.steps.push(...(await this.#quadrantSteps(axis, mirrored)));
    this.steps.push(...(await this.#pictureSteps(width, height)));
  }

  /**
   * Textures of both axes, of so many rows each, with a texel more a row for what nobody reads. Axes take turns: where
   * they are alike they share one.
   */
  #rowsTextures(label, rowsOf) {
    const sizes = this.axes.map((axis) => [axis.length + 1, rowsOf(axis)]);
    const both = [0, 1].map((side) => Math.max(...sizes.map((size) => size[side])));
    const area = ([width, height]) => width * height;
    if (area(both) > area(sizes[0]) + area(sizes[1])) return sizes.map((size) => this.plan.texture(label, ...size));
    const shared = this.plan.texture(label, ...both);
    return [shared, shared];
  }

  /** Segments of level 0 are not kept. */
  #segmentTextures(level) {
    if (level === 0) return null;
    const rowsOf = (axis) => (level < axis.levels ? this.media.planes * raysOf(axis, level) : 1);
    return this.#rowsTextures(`T${level}`, rowsOf);
  }

  #radianceTextures(parity) {
    const levels = (axis) => levelsOf(axis).filter((level) => level % 2 === parity);
    return this.#rowsTextures(`R${parity}`, (axis) => Math.max(1, ...levels(axis).map((level) => conesOf(axis, level))));
  }

  #kernel(name) {
    return `${name}_${this.media.world}`;
  }

  /** A dispatch whose groups go through rows. */
  #rowStep(wanted) {
    return this.plan.step({ ...wanted, constants: { ...wanted.constants, LANES: this.#kit.lanes } });
  }

  #loadStep(width, height) {
    const { size, emission, extinction } = this.world;
    return this.plan.step({
      stage: "field",
      kernel: this.#kernel("world"),
      entry: "load",
      bindings: { 0: size, 1: emission, 2: extinction, 3: this.cells[0], 4: this.cells[1] },
      groups: groupsFor(width * height),
    });
  }

  /** Where a quadrant has anything to trace. */
  #nearStep({ index, axis, mirrored, near }) {
    const { width, words } = axis;
    return this.plan.step({
      stage: "field",
      kernel: "near",
      entry: "find",
      bindings: {
        0: this.plan.uniform("quadrant", u32(width, words, mirrored)),
        1: this.occupied[index],
        2: near,
      },
      groups: groupsFor(width * words),
    });
  }

  #pictureSteps(width, height) {
    const { size, emission } = this.world;
    const { sums, listed, light } = this;
    const [, occupied] = this.occupied;
    const means = this.firstSums[1]; // nobody reads these any more
    return pictureSteps(this.#kit, this.plan, { size, emission, occupied, sums, means, listed, light, width, height });
  }

  async #quadrantSteps(axisIndex, mirrored) {
    const axis = this.axes[axisIndex];
    const near = this.plan.buffer("near", 4 * NEAR_LEVELS * axis.width * axis.words);
    const quadrant = { index: axisIndex, axis, mirrored, near };
    const levels = levelsOf(axis).slice(1);
    const steps = [await this.#nearStep(quadrant)];
    for (const level of levels.filter((n) => n <= TRACED_LEVEL))
      steps.push(...(await this.#traceSteps(quadrant, level)));
    if (levels.includes(BETWEEN_LEVEL)) steps.push(...(await this.#traceBetweenSteps(quadrant)));
    for (const level of levels.slice(TRACED_LEVEL - 1, -1)) steps.push(await this.#extendStep(quadrant, level));
    for (const level of levels.toReversed()) steps.push(...(await this.#mergeSteps(quadrant, level)));
    steps.push(...(await this.#receiveSteps(quadrant)));
    return steps;
  }

  #uniform({ axis, mirrored }, level, first = 1, stride = 1) {
    const columns = [columnsOf(axis, level), columnsOf(axis, level + 1)];
    const place = [mirrored, first, stride, ...axis.pixelSteps];
    const rows = [raysBelow(axis, level), raysBelow(axis, level + 1), raysBelow(axis, axis.levels)];
    const fields = u32(axis.width, axis.length, 2 ** level, ...columns, ...place, axis.words, ...rows);
    return this.plan.uniform("quadrant", fields);
  }

  /** What tracing reads. */
  #tapBindings({ index, near }) {
    const world = this.cells?.[index] ?? this.world.emission;
    return { 1: world, 3: this.counters, 9: near };
  }

  #blocksOf({ index, mirrored }) {
    return this.blocks[2 * index + mirrored];
  }

  /** Column 0 is never asked for, and of level 1 only odd ones are. */
  #traceSteps(quadrant, level) {
    const reach = 2 ** level;
    const rises = Array.from({ length: reach + 1 }, (_, k) => 2 * k - reach);
    return this.#traceRises(quadrant, level, rises, this.segments[level]);
  }

  #traceBetweenSteps(quadrant) {
    return this.#traceRises(quadrant, BETWEEN_LEVEL, BETWEEN_RISES, this.between);
  }

  #traceRises(quadrant, level, rises, into) {
    const stride = level === 1 ? 2 : 1;
    const columns = columnsOf(quadrant.axis, level);
    const reach = 2 ** level;
    return Promise.all(
      rises.map((rise) =>
        this.#rowStep({
          stage: "trace",
          kernel: this.#kernel("strip"),
          entry: "trace",
          constants: { REACH: reach, RISE: rise },
          bindings: {
            0: this.#uniform(quadrant, level, 1, stride),
            ...this.#tapBindings(quadrant),
            4: into[quadrant.index],
            8: this.#blocksOf(quadrant),
          },
          groups: [Math.ceil((columns - 1) / stride), windowsFor(quadrant.axis.blocks), 1],
        }),
      ),
    );
  }

  /** T of level + 1. */
  #extendStep(quadrant, level) {
    return this.#rowStep({
      stage: "extend",
      kernel: this.#kernel("column"),
      entry: "extend",
      constants: { BETWEEN: Number(level + 1 === BETWEEN_LEVEL) },
      bindings: {
        0: this.#uniform(quadrant, level),
        1: this.segments[level][quadrant.index],
        2: this.between[quadrant.index],
        4: this.segments[level + 1][quadrant.index],
        8: this.#blocksOf(quadrant),
        10: this.#kit.nearest,
      },
      groups: [2 ** level + 1, columnsOf(quadrant.axis, level + 1) - 1, windowsFor(quadrant.axis.blocks)],
    });
  }

  /** What merges of a level read of the one above. */
  #mergeBindings({ index }, level) {
    return { 5: this.radiance[(level + 1) % 2][index], 6: this.weights, 7: this.world.sky, 10: this.#kit.nearest };
  }

  /** Pairs of columns: the first, those between, and the last. */
  #mergeSteps(quadrant, level) {
    const last = Math.ceil(columnsOf(quadrant.axis, level) / 2) - 1;
    const runs = [
      { first: 0, count: 1, constants: { HAS_EVEN: 0, HAS_BEYOND: Number(last > 0) } },
      { first: 1, count: last - 1, constants: { HAS_EVEN: 1, HAS_BEYOND: 1 } },
      { first: last, count: Math.min(last, 1), constants: { HAS_EVEN: 1, HAS_BEYOND: 0 } },
    ];
    return Promise.all(runs.filter(({ count }) => count > 0).map((run) => this.#mergeStep(quadrant, level, run)));
  }

  #mergeStep(quadrant, level, { first, count, constants }) {
    const beside = Math.ceil(2 ** level / BLOCK); // blocks that only one of the two columns has
    return this.#rowStep({
      stage: "merge",
      kernel: this.#kernel("merge"),
      entry: "merge",
      constants,
      bindings: {
        0: this.#uniform(quadrant, level, first),
        1: this.segments[level][quadrant.index],
        2: this.segments[Math.min(level + 1, this.levels - 1)][quadrant.index], // the top level has no even columns
        4: this.radiance[level % 2][quadrant.index],
        8: this.#blocksOf(quadrant),
        ...this.#mergeBindings(quadrant, level),
      },
      groups: [2 ** level, count, windowsFor(quadrant.axis.blocks + beside)],
    });
  }

  /** Pixels before odd columns, and before even ones. The second quadrant of an axis adds to the first. */
  #receiveSteps(quadrant) {
    const { width, blocks } = quadrant.axis;
    const runs = [
      { reach: 1, first: 0, count: (width + 1) >> 1 },
      { reach: 2, first: 1, count: width >> 1 },
    ];
    return Promise.all(
      runs
        .filter(({ count }) => count > 0)
        .map(({ reach, first, count }) =>
          this.#rowStep({
            stage: "gather",
            kernel: this.#kernel("gather"),
            entry: "receive",
            constants: { MEDIA: Number(this.media.chords > 0), ADD: quadrant.mirrored, REACH: reach },
            bindings: {
              0: this.#uniform(quadrant, 0, first),
              ...this.#tapBindings(quadrant),
              4: (quadrant.mirrored ? this.sums : this.firstSums)[quadrant.index],
              ...this.#mergeBindings(quadrant, 0),
              11: (quadrant.mirrored ? this.firstSums : this.sums)[quadrant.index],
            },
            groups: [count, windowsFor(blocks), 1],
          }),
        ),
    );
  }

  async solve(world) {
    this.world.upload(world);
    this.#uploadOccupancy(world);
    const reads = [
      { buffer: this.light, bytes: 12 * world.width * world.height },
      { buffer: this.counters, bytes: 4 * NEAR_LEVELS },
    ];
    const clears = [this.counters, this.listed, ...this.blocks];
    const { results, stages } = await this.plan.run(this.steps, { clears, reads });
    return {
      light: new Float32Array(results[0]),
      levels: this.#levelStats(new Uint32Array(results[1])),
      skip: null,
      stages: summed(stages),
    };
  }

  #uploadOccupancy(world) {
    const { queue } = this.#kit.device;
    occupancyOf(world).forEach((lines, axis) => queue.writeBuffer(this.occupied[axis], 0, lines));
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
