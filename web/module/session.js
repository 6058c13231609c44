// A session of the module (web/wasm/session.h) as methods: what worker.js answers requests with.
import { DappleError } from "./core.js";
import { LEVEL_NUMBERS, STATS_NUMBERS, MAX_LEVELS, readStats } from "./stats.js";

const SOLVERS = { cascades: 0, reference: 1, holographic: 2 };
const MERGES = { bilinear: 0, "bilinear-fix": 1, "nearest-fix": 2 };
const SKIPS = { off: 0, L5: 1, L4: 2, L3: 3, L2: 4, auto: 5, exact: 7, bounded: 8 };
const SHADOWS = { exact: 0, reference: 1, mrma: 13, rays: 14 };
const FALLOFFS = { subtractive: 0, multiplicative: 1, euclidean: 2, round: 3 };
const FLOOD_NUMBERS = ["visits", "pushes", "removals", "fromScratch", "ms"]; // of web/wasm/flood.c
const EMISSION = 0, EXTINCTION = 1, ALBEDO = 2, LIGHT = 3;
const LIGHTS_MAX = 64, LIGHT_NUMBERS = 7;

/** By name, or an error that lists the names. */
function pick(table, name, what) {
  if (Object.hasOwn(table, name)) return table[name];
  throw new DappleError("argument", `there is no ${what} "${name}"; there are ${Object.keys(table).join(", ")}`);
}

export class Session {
  /** Makes a session of `helpers` + 1 threads. */
  constructor(core, helpers) {
    this.core = core;
    this.call = core.call;
    this.handle = this.call.dpl_web_open(helpers);
    if (!this.handle) throw new DappleError("memory", "the module could not start a session");
  }

  get isa() {
    return this.core.text(this.call.dpl_web_isa(this.handle));
  }

  /** Where the crew is, and the top of a stack for each helper. */
  crew(helpers, stackBytes) {
    const stacks = [];
    for (let i = 0; i < helpers; i++) {
      const bottom = this.call.malloc(stackBytes);
      if (!bottom) throw new DappleError("memory", "no memory for a helper's stack");
      stacks.push((bottom + stackBytes) & ~15);
    }
    return { address: this.call.dpl_web_crew_of(this.handle), stacks };
  }

  families() {
    const families = [];
    for (let i = 0; ; i++) {
      const name = this.call.dpl_web_family_name(i);
      if (!name) return families;
      families.push({ name: this.core.text(name), count: this.call.dpl_web_family_count(i) });
    }
  }

  plane(index, values) {
    return this.core.floats(this.call.dpl_web_plane(this.handle, index), values);
  }

  resize(width, height) {
    this.core.check(this.call.dpl_web_resize(this.handle, width, height), this.handle);
  }

  draw(world) {
    const values = 3 * world.width * world.height, [red, green, blue] = world.sky ?? [0, 0, 0];
    this.resize(world.width, world.height);
    this.plane(EMISSION, values).set(world.emission);
    this.plane(EXTINCTION, values).set(world.extinction);
    if (world.albedo) this.plane(ALBEDO, values).set(world.albedo);
    this.core.check(this.call.dpl_web_draw(this.handle, world.albedo ? 1 : 0, red, green, blue), this.handle);
  }

  solve(world, settings, watched) {
    const solver = pick(SOLVERS, settings.solver ?? "holographic", "solver");
    const merge = pick(MERGES, settings.merge ?? "bilinear-fix", "merge");
    const skip = pick(SKIPS, settings.skip ?? "off", "skip mode");
    const { width, height } = world, start = performance.now();
    this.draw(world);
    const drawn = performance.now();
    const status = this.call.dpl_web_solve(this.handle, solver, settings.bounces ?? 0, merge, skip,
      settings.boundDb ?? 0, settings.directions ?? 0, watched ? 1 : 0, settings.reuse ? 1 : 0);
    this.core.check(status, this.handle);
    const light = this.plane(LIGHT, 3 * width * height).slice();
    return { width, height, light, stats: this.stats(solver === SOLVERS.cascades, drawn - start) };
  }

  stats(skips, drawMs) {
    const count = STATS_NUMBERS.length + MAX_LEVELS * LEVEL_NUMBERS.length;
    return this.core.withBytes(8 * count, (address) => {
      this.call.dpl_web_stats(this.handle, address);
      return readStats(this.core.doubles(address, count), skips, drawMs);
    });
  }

  distance(world) {
    this.draw(world);
    this.core.check(this.call.dpl_web_distance(this.handle), this.handle);
    return this.plane(LIGHT, world.width * world.height).slice();
  }

  shadows(world, lights, method) {
    const number = pick(SHADOWS, method, "shadow method");
    const rows = lights.flatMap((l) => [...l.position, l.radius, ...l.color, l.intensity]);
    this.draw(world);
    return this.core.withBytes(8 * rows.length, (address) => {
      this.core.doubles(address, rows.length).set(rows);
      this.core.check(this.call.dpl_web_shadow(this.handle, number, address, lights.length), this.handle);
      return this.plane(LIGHT, 3 * world.width * world.height).slice();
    });
  }

  flood({ width, height, walls, lights }, { falloff = "round", range = 16 }) {
    const number = pick(FALLOFFS, falloff, "falloff"), cells = width * height;
    this.core.check(this.call.dpl_web_flood_open(this.handle, width, height, number, range), this.handle);
    this.core.bytes(this.call.dpl_web_flood_walls(this.handle), cells).set(walls);
    const plane = () => this.core.floats(this.call.dpl_web_flood_lights(this.handle), 3 * cells);
    plane().set(lights);
    return this.core.withBytes(8 * FLOOD_NUMBERS.length, (address) => {
      this.core.check(this.call.dpl_web_flood_update(this.handle, address), this.handle);
      const found = this.core.doubles(address, FLOOD_NUMBERS.length);
      const stats = Object.fromEntries(FLOOD_NUMBERS.map((name, i) => [name, found[i]]));
      stats.fromScratch = stats.fromScratch !== 0;
      return { width, height, light: plane().slice(), stats };
    });
  }

  scene(family, seed, index, width, height) {
    const number = this.families().findIndex((f) => f.name === family);
    return this.core.withBytes(8 * (4 + LIGHTS_MAX * LIGHT_NUMBERS), (address) => {
      const sky = address, count = address + 24, rows = address + 32;
      this.core.checkReported(this.call.dpl_web_scene(this.handle, number, BigInt.asUintN(64, BigInt(seed)),
        index, width, height, sky, rows, count));
      const values = 3 * width * height;
      const lights = [], found = new Int32Array(this.core.memory.buffer, count, 1)[0];
      for (let i = 0; i < found; i++) {
        const [x, y, radius, ...rest] = this.core.doubles(rows + 8 * LIGHT_NUMBERS * i, LIGHT_NUMBERS);
        lights.push({ position: [x, y], radius, color: rest.slice(0, 3), intensity: rest[3] });
      }
      return {
        width, height, lights,
        sky: [...this.core.doubles(sky, 3)],
        emission: this.plane(EMISSION, values).slice(),
        extinction: this.plane(EXTINCTION, values).slice(),
        albedo: this.plane(ALBEDO, values).slice(),
      };
    });
  }

  compare(test, reference, width, height, mask) {
    const values = 3 * width * height;
    this.resize(width, height);
    this.plane(EMISSION, values).set(test);
    this.plane(EXTINCTION, values).set(reference);
    return this.core.withBytes(48 + (mask?.length ?? 0), (address) => {
      if (mask) new Uint8Array(this.core.memory.buffer, address + 48, mask.length).set(mask);
      this.core.check(this.call.dpl_web_compare(this.handle, mask ? address + 48 : 0, address), this.handle);
      const [psnrLinear, psnrDisplay, relRmse, ssim, flip, pixels] = this.core.doubles(address, 6);
      return { psnrLinear, psnrDisplay, relRmse, ssim, flip, pixels };
    });
  }

  /** Yields the record of each scene; `record` is filled by the host's number(). */
  *study({ seed, size, scenes, truth }, record) {
    this.core.checkReported(this.call.dpl_web_study_open(this.handle, BigInt.asUintN(64, BigInt(seed)), size,
      scenes, truth));
    try {
      for (let i = 0; i < scenes; i++) {
        this.core.checkReported(this.call.dpl_web_study_next(this.handle));
        this.call.dpl_web_study_read(this.handle);
        yield record(i);
      }
      return this.correlations();
    } finally {
      this.call.dpl_web_study_close(this.handle);
    }
  }

  correlations() {
    const rows = [];
    for (const [p, profile] of ["paper", "corrected"].entries())
      for (let s = 0; this.call.dpl_web_study_signal(s); s++)
        for (const [q, quality] of ["psnr_display", "psnr_linear"].entries())
          rows.push(this.core.withBytes(40, (address) => {
            this.core.checkReported(this.call.dpl_web_study_correlate(this.handle, p, s, q, address));
            const [r, low, high, pValue, count] = this.core.doubles(address, 5);
            const signal = this.core.text(this.call.dpl_web_study_signal(s));
            return { profile, signal, quality, r, low, high, p: pValue, count };
          }));
    return rows;
  }
}
