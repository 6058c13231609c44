/**
 * A caller's world, checked and copied, and its way to pixels on the device. Used by cascades.js and holographic.js; a
 * pixel is what src/field/layer.c says it is.
 */
import { groupsFor, u32 } from "./plan.js";

/** Largest width and height [px], DPL_MAX_SIZE of the library. */
export const MAX_SIZE = 16384;

/** What pixels are, apart from empty ones, which have 0. */
const MEDIUM = 1;
const OPAQUE = 2;

/** A medium that lets nothing of a colour through; WGSL does not promise to keep an infinite float. */
const EXTINCTION_MAX = 1e30;

/** What a pixel with these extinctions is, some of which are not 0. */
function kindOf(r, g, b) {
  return r === Infinity && g === Infinity && b === Infinity ? OPAQUE : MEDIUM;
}

function checkLength(name, plane, width, height) {
  const length = width * height * 3;
  if (!(plane instanceof Float32Array) || plane.length !== length)
    throw new TypeError(`${name} must be a Float32Array of width * height * 3 = ${length}`);
}

function badValue(name, plane, index, width) {
  const pixel = Math.floor(index / 3);
  return new RangeError(`${name} of pixel (${pixel % width}, ${Math.floor(pixel / width)}) is ${plane[index]}`);
}

/** Emission is 0 to 3e38, extinction 0 to Infinity. */
function checkPixel(emission, extinction, pixel, width) {
  for (let i = 3 * pixel; i < 3 * pixel + 3; i++) {
    if (!(emission[i] >= 0 && emission[i] <= 3e38)) throw badValue("emission", emission, i, width);
    if (!(extinction[i] >= 0)) throw badValue("extinction", extinction, i, width);
  }
}

/** Floats as bits: most are 0, and that is seen sooner so. */
function bitsOf(plane) {
  return new Int32Array(plane.buffer, plane.byteOffset, plane.length);
}

function checkSize(width, height) {
  const good = (n) => Number.isInteger(n) && n >= 1 && n <= MAX_SIZE;
  if (!good(width) || !good(height))
    throw new RangeError(`a world is 1 to ${MAX_SIZE} pixels wide and high, not ${width} x ${height}`);
}

/**
 * Pixels as src/field/layer.c has them, checked and copied. Every frame comes by here, so it is one plain loop.
 * @returns {{emission: Float32Array, extinction: Float32Array | null, media: "none" | "grey" | "rgb"}}
 *   four numbers a pixel: RGB and what it is; RGB and 0 of media, or null where there are none; "rgb" where one lets
 *   colours through differently
 */
function pixelsOf(emission, extinction, width) {
  const [shown, opacity] = [bitsOf(emission), bitsOf(extinction)];
  const pixels = emission.length / 3;
  const taken = { emission: new Float32Array(4 * pixels), extinction: null, media: "none" };
  for (let pixel = 0, i = 0; pixel < pixels; pixel++, i += 3) {
    const anything = shown[i] | shown[i + 1] | shown[i + 2] | opacity[i] | opacity[i + 1] | opacity[i + 2];
    if (anything === 0) continue; // most pixels are dark and empty
    checkPixel(emission, extinction, pixel, width);
    const [r, g, b] = [extinction[i], extinction[i + 1], extinction[i + 2]];
    if (r === 0 && g === 0 && b === 0) continue; // what is empty does not shine
    const kind = kindOf(r, g, b);
    setPixel(taken.emission, pixel, emission[i], emission[i + 1], emission[i + 2], kind);
    if (kind === MEDIUM) addMedium(taken, pixel, r, g, b);
  }
  return taken;
}

function setPixel(plane, pixel, x, y, z, w) {
  const at = 4 * pixel;
  plane[at] = x;
  plane[at + 1] = y;
  plane[at + 2] = z;
  plane[at + 3] = w;
}

function addMedium(taken, pixel, r, g, b) {
  const most = EXTINCTION_MAX;
  taken.extinction ??= new Float32Array(taken.emission.length);
  setPixel(taken.extinction, pixel, Math.min(r, most), Math.min(g, most), Math.min(b, most), 0);
  if (taken.media !== "rgb") taken.media = r === g && r === b ? "grey" : "rgb";
}

/**
 * Checks a world and copies its pixels, so that the caller may go on drawing.
 * @param {import("dapple").World} world
 */
export function takeWorld({ width, height, emission, extinction, sky = [0, 0, 0] }) {
  checkSize(width, height);
  checkLength("emission", emission, width, height);
  checkLength("extinction", extinction, width, height);
  if (sky.length !== 3 || !sky.every((value) => Number.isFinite(value) && value >= 0))
    throw new RangeError(`the sky must be three finite numbers of 0 or more, not ${sky}`);
  return { width, height, sky: new Float32Array(sky), ...pixelsOf(emission, extinction, width) };
}

/** What a pixel of a taken world is: 0 where it is empty. */
export function kindAt({ emission }, pixel) {
  return emission[4 * pixel + 3];
}

export function isOpaque(world, x, y) {
  return kindAt(world, y * world.width + x) === OPAQUE;
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
    this.emission = plan.buffer("emission", 16 * pixels);
    this.extinction = plan.buffer("extinction", hasMedia ? 16 * pixels : 16); // nothing is read where there are none
  }

  upload(world) {
    const { queue } = this.kit.device;
    queue.writeBuffer(this.emission, 0, world.emission);
    if (this.hasMedia) queue.writeBuffer(this.extinction, 0, world.extinction);
    queue.writeBuffer(this.sky, 0, world.sky);
  }

  /** The steps that measure distances between pixels into `clearance`. */
  distanceSteps(clearance) {
    const { plan, size, emission } = this;
    const runs = plan.buffer("runs", 4 * this.pixels);
    const envelope = plan.buffer("envelope", 8 * this.pixels);
    const columns = { 0: size, 1: emission, 2: runs };
    const rows = { ...columns, 3: envelope, 4: clearance };
    const steps = [
      { entry: "columns", bindings: columns, items: this.width },
      { entry: "rows", bindings: rows, items: this.height },
    ];
    return Promise.all(
      steps.map(({ items, ...step }) => plan.step({ stage: "field", kernel: "distance", ...step, groups: groupsFor(items) })),
    );
  }
}
