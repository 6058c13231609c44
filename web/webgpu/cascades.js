/** Radiance cascades on the device: docs/algorithms/radiance-cascades.md. Called by index.js. */
import { Plan, f32, groupsFor, u32 } from "./plan.js";
import { directionsOf, scheduleOf } from "./schedule.js";
import { SIGNAL_RAYS, SKIP_RULES, chooseMode, ringsOf, segmentsOf, signalPoints, signalsOf } from "./skip.js";
import { WorldBuffers, isOpaque } from "./world.js";

const MERGES = { bilinear: 1, "bilinear-fix": 2, "nearest-fix": 3 };
const MERGE_OF_TOP = 0;

/** Of the list of items whose rays are marched: bytes of an item, and most invocations that go through it, per lane. */
const NEAR_BYTES = 8;
const MARCHING = 1024; // those that find the list too short march all the same on a software adapter

export function refusal({ merge = "bilinear-fix", skip = "off" }) {
  if (!Object.hasOwn(MERGES, merge)) return `there is no merge "${merge}"`;
  if (skip === "exact" || skip === "bounded") return `skip "${skip}" is not on WebGPU; the wasm back end has it`;
  if (skip !== "auto" && !Object.hasOwn(SKIP_RULES, skip)) return `there is no skip "${skip}"`;
  return null;
}

/** The largest buffer [byte]. */
export function largestBuffer(width, height) {
  return 16 * width * height; // of pixels
}

/** Slots of a level lie beside each other in its texture, and there is a column for what nobody reads [texel]. */
function radianceSize({ number, probes }) {
  return [2 ** number * probes[0] + 1, 2 ** number * probes[1]];
}

/** The longest side of a texture [texel]. */
export function largestTexture(width, height) {
  return Math.max(width + 2, height + 2, ...scheduleOf(width, height, "bilinear").flatMap(radianceSize));
}

/** What solves of the same key share. */
export function keyOf(world, { merge = "bilinear-fix" }) {
  return `${world.width} ${world.height} ${merge} ${world.media !== "none"}`;
}

/** Do all probes of all levels stand in the picture? Rays that leave it then never come back. */
function areAllInside(levels, width, height) {
  return levels.every(({ probes, spacing }) => probes[0] * spacing === width && probes[1] * spacing === height);
}

/** Blocks of a level, as shaders/level.wgsl has them: one before the first parent, and one behind each. */
function blocksOf({ probes }) {
  return probes.map((count) => (count >> 1) + 1);
}

/** Slots of all blocks. */
function itemCount(level) {
  const blocks = blocksOf(level);
  return blocks[0] * blocks[1] * level.slots;
}

export class CascadesPlan {
  #kit;

  static async make(kit, world, { merge = "bilinear-fix" }) {
    const made = new CascadesPlan();
    made.#kit = kit;
    made.plan = new Plan(kit);
    try {
      await made.#build(world, merge);
    } catch (error) {
      made.destroy();
      throw error;
    }
    return made;
  }

  async #build(world, merge) {
    const { width, height } = world;
    this.size = [width, height];
    this.levels = scheduleOf(width, height, merge);
    this.world = new WorldBuffers(this.#kit, this.plan, width, height, world.media !== "none");
    this.grid = this.plan.texture("grid", width + 2, height + 2);
    this.counters = this.plan.buffer("counters", 8 * this.levels.length);
    this.rule = this.plan.uniform("skip rule", u32(0, 0));
    this.light = this.plan.buffer("light", 12 * width * height);
    this.constants = { MEDIA: Number(world.media !== "none") };
    this.fieldSteps = await this.#makeFieldSteps(width, height);
    this.levelSteps = await this.#makeLevelSteps(width, height, MERGES[merge]);
  }

  async #makeFieldSteps(width, height) {
    const clearance = this.plan.buffer("clearance", 4 * width * height);
    const bindings = { 0: this.world.size, 1: this.world.emission, 2: clearance, 3: this.grid };
    const groups = groupsFor((width + 2) * (height + 2));
    const steps = await this.world.distanceSteps(clearance);
    return [...steps, await this.plan.step({ stage: "field", kernel: "grid", entry: "draw", bindings, groups })];
  }

  /** What march.wgsl reads. */
  get #walk() {
    return { 1: this.grid, 3: this.world.extinction, 10: this.#kit.nearest };
  }

  #levelUniform(level, above, firstDirection, width, height) {
    const { probes, number, spacing, t0, t1, radius, widening } = level;
    return this.plan.uniform(
      `level ${number}`,
      u32(width, height, ...probes, ...(above?.probes ?? [0, 0]), ...blocksOf(level), number, firstDirection),
      f32(spacing, t0, t1, radius, widening),
    );
  }

  /** What is clear of a level, and what is not. */
  async #makeLevelStep(level, kind, shared, uniform, radiance) {
    const items = itemCount(level);
    const inside = areAllInside(this.levels, ...this.size);
    const constants = { ...this.constants, MERGE: kind, ENTERS: Number(kind > MERGES.bilinear || !inside) };
    const bindings = {
      ...shared,
      ...this.#walk,
      0: uniform,
      5: radiance[(level.number + 1) % 2],
      6: radiance[level.number % 2],
      7: this.counters,
    };
    const stage = `level ${level.number}`;
    return [
      await this.plan.step({ stage, kernel: "clear", entry: "merge", constants, bindings, groups: groupsFor(items) }),
      await this.plan.step({
        stage,
        kernel: "trace",
        entry: "solve",
        constants,
        bindings,
        groups: groupsFor(Math.min(items, MARCHING * this.#kit.lanes)),
      }),
    ];
  }

  /** Levels from the top down, in two textures of radiance, and the picture. */
  async #makeLevelSteps(width, height, merge) {
    const radiance = [0, 1].map((parity) => {
      const sizes = this.levels.filter((level) => level.number % 2 === parity).map(radianceSize);
      return this.plan.texture("radiance", ...[0, 1].map((side) => Math.max(1, ...sizes.map((size) => size[side]))));
    });
    const shared = {
      4: this.plan.constant("directions", directionsOf(this.levels)),
      8: this.rule,
      9: this.world.sky,
      11: this.plan.buffer("near", NEAR_BYTES * Math.max(...this.levels.map(itemCount))),
    };
    const steps = [];
    let firstDirection = 0;
    for (const level of this.levels) {
      const above = this.levels[level.number + 1];
      const uniform = this.#levelUniform(level, above, firstDirection, width, height);
      firstDirection += 2 * level.directions;
      steps.unshift(...(await this.#makeLevelStep(level, above ? merge : MERGE_OF_TOP, shared, uniform, radiance)));
    }
    const picture = this.plan.uniform("picture", u32(width, height));
    const shown = { 0: picture, 1: this.world.emission, 2: radiance[0], 3: this.light, 10: this.#kit.nearest };
    const groups = groupsFor(width * height);
    steps.push(await this.plan.step({ stage: "picture", kernel: "pixels", entry: "show", bindings: shown, groups }));
    return steps;
  }

  /** The step that looks around, and its buffers; made when it is first wanted. */
  async #makeRings(world) {
    const segments = this.plan.buffer("segments", 16 * SIGNAL_RAYS);
    const seen = this.plan.buffer("seen", 32 * SIGNAL_RAYS);
    const rays = this.plan.uniform("rings", u32(world.width, world.height, SIGNAL_RAYS));
    const step = await this.plan.step({
      stage: "signals",
      kernel: "choose",
      entry: "look",
      constants: this.constants,
      bindings: { 0: rays, ...this.#walk, 4: segments, 5: seen },
      groups: groupsFor(SIGNAL_RAYS),
    });
    return { segments, seen, step };
  }

  /** Measures the signals of a world whose field is on the device. */
  async #measure(world) {
    const points = signalPoints(world.width, world.height, (x, y) => isOpaque(world, x, y));
    const segments = segmentsOf(points, this.levels[0].t1, Math.hypot(world.width, world.height));
    this.rings ??= await this.#makeRings(world);
    this.#kit.device.queue.writeBuffer(this.rings.segments, 0, segments);
    const reads = [{ buffer: this.rings.seen, bytes: 2 * segments.byteLength }];
    const { results, stages } = await this.plan.run([...this.fieldSteps, this.rings.step], { reads });
    const signals = signalsOf(ringsOf(new Float32Array(results[0]), world.sky));
    return { signals, stages };
  }

  async solve(world, { skip = "off" }) {
    this.world.upload(world);
    const measured = skip === "auto" ? await this.#measure(world) : null;
    const chosen = measured ? chooseMode(measured.signals.score) : skip;
    const { startLevel, maxBits } = SKIP_RULES[chosen];
    this.#kit.device.queue.writeBuffer(this.rule, 0, u32(startLevel, maxBits));
    const steps = measured ? this.levelSteps : [...this.fieldSteps, ...this.levelSteps];
    const reads = [
      { buffer: this.light, bytes: 12 * world.width * world.height },
      { buffer: this.counters, bytes: 8 * this.levels.length },
    ];
    const { results, stages } = await this.plan.run(steps, { clears: [this.counters], reads });
    const { score = null, ...signals } = measured?.signals ?? {};
    return {
      light: new Float32Array(results[0]),
      levels: this.#levelStats(new Uint32Array(results[1])),
      skip: { signals, score, chosen },
      stages: [...(measured?.stages ?? []), ...stages],
    };
  }

  #levelStats(traced) {
    return this.levels.map(({ probeCount, directions, raysFull }, i) => ({
      probes: probeCount,
      directions,
      raysFull,
      raysTraced: traced[2 * i],
    }));
  }

  destroy() {
    this.plan.destroy();
  }
}
