/**
 * A caller's world, checked and copied, and its way to pixels on the device. Used by cascades.js and holographic.js; a
 * pixel is what src/field/layer.c says it is.
 */
import { groupsFor, u32 } from "./plan.js";

/** Largest width and height [px], DPL_MAX_SIZE of the library. */
export const MAX_SIZE = 16384;

const EMPTY = 0;
const MEDIUM = 1;
const OPAQUE = 2;

/** What a pixel with these extinctions is. */
function kindOf(r, g, b) {
  if (!(r > 0 || g > 0 || b > 0)) return EMPTY;
  return r === Infinity && g === Infinity && b === Infinity ? OPAQUE : MEDIUM;
}

function checkPlane(name, plane, width, height, highest) {
  const length = width * height * 3;
  if (!(plane instanceof Float32Array) || plane.length !== length)
    throw new TypeError(`${name} must be a Float32Array of width * height * 3 = ${length}`);
  let bad = 0; // a loop, for every frame comes by here: findIndex() takes ten times as long
  while (bad < length && plane[bad] >= 0 && plane[bad] <= highest) bad++;
  if (bad === length) return;
  const pixel = Math.floor(bad / 3);
  throw new RangeError(`${name} of pixel (${pixel % width}, ${Math.floor(pixel / width)}) is ${plane[bad]}`);
}

function checkSize(width, height) {
  const good = (n) => Number.isInteger(n) && n >= 1 && n <= MAX_SIZE;
  if (!good(width) || !good(height))
    throw new RangeError(`a world is 1 to ${MAX_SIZE} pixels wide and high, not ${width} x ${height}`);
}

/** What media there are: "none", "grey", or "rgb" where one lets colours through differently. */
function findMedia(extinction) {
  let media = "none";
  for (let i = 0; i < extinction.length; i += 3) {
    const r = extinction[i];
    const g = extinction[i + 1];
    const b = extinction[i + 2];
    if (r === g && r === b && (r === 0 || r === Infinity)) continue; // most pixels
    if (kindOf(r, g, b) !== MEDIUM) continue;
    if (r !== g || r !== b) return "rgb";
    media = "grey";
  }
  return media;
}

/**
 * Checks a world and copies its planes, so that the caller may go on drawing.
 * @param {import("dapple").World} world
 */
export function takeWorld({ width, height, emission, extinction, sky = [0, 0, 0] }) {
  checkSize(width, height);
  checkPlane("emission", emission, width, height, 3e38);
  checkPlane("extinction", extinction, width, height, Infinity);
  if (sky.length !== 3 || !sky.every((value) => Number.isFinite(value) && value >= 0))
    throw new RangeError(`the sky must be three finite numbers of 0 or more, not ${sky}`);
  return {
    width,
    height,
    emission: emission.slice(),
    extinction: extinction.slice(),
    sky: new Float32Array(sky),
    media: findMedia(extinction),
  };
}

export function isOpaque(world, x, y) {
  const i = 3 * (y * world.width + x);
  return kindOf(world.extinction[i], world.extinction[i + 1], world.extinction[i + 2]) === OPAQUE;
}

/** The world's pixels in a plan's buffers. */
export class WorldBuffers {
  /**
   * @param {import("./plan.js").Plan} plan
   * @param {boolean} hasMedia whether `extinction` is wanted
   */
  constructor(kit, plan, width, height, hasMedia) {
    const pixels = width * height;
    this.kit = kit;
    this.plan = plan;
    this.width = width;
    this.height = height;
    this.pixels = pixels;
    this.hasMedia = hasMedia;
    this.size = plan.uniform("size", u32(width, height));
    this.sky = plan.uniform("sky", new Float32Array(3));
    this.emissionPlane = plan.buffer("emission plane", 12 * pixels);
    this.extinctionPlane = plan.buffer("extinction plane", 12 * pixels);
    this.emission = plan.buffer("emission", 16 * pixels);
    this.extinction = plan.buffer("extinction", hasMedia ? 16 * pixels : 16);
  }

  upload(world) {
    const { queue } = this.kit.device;
    queue.writeBuffer(this.emissionPlane, 0, world.emission);
    queue.writeBuffer(this.extinctionPlane, 0, world.extinction);
    queue.writeBuffer(this.sky, 0, world.sky);
  }

  /** The steps that make pixels of the planes, and measure distances into `clearance`. */
  fieldSteps(clearance) {
    const { plan, size, emission } = this;
    const { width, height } = this;
    const runs = plan.buffer("runs", 4 * this.pixels);
    const envelope = plan.buffer("envelope", 8 * this.pixels);
    const planes = { 1: this.emissionPlane, 2: this.extinctionPlane };
    const columns = { 0: size, 1: emission, 2: runs };
    const rows = { ...columns, 3: envelope, 4: clearance };
    const steps = [
      {
        kernel: "layer",
        entry: "draw",
        constants: { MEDIA: Number(this.hasMedia) },
        bindings: { 0: size, ...planes, 3: emission, 4: this.extinction },
        items: this.pixels,
      },
      { kernel: "distance", entry: "columns", bindings: columns, items: width },
      { kernel: "distance", entry: "rows", bindings: rows, items: height },
    ];
    return Promise.all(
      steps.map(({ items, ...step }) => plan.step({ stage: "field", ...step, groups: groupsFor(items) })),
    );
  }
}
