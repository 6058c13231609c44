// The planes of a pixel world as the back ends read them, and the colours of the floor, which only the view
// "lit colours" uses. Called by everything that draws or reads pixels.
import { forEachPixel } from "./shapes.js";

/** Names of the planes: three floats per pixel each. */
export const PLANES = ["emission", "extinction", "albedo", "floor"];

/** Colour of the floor where nobody painted one, linear. */
const BARE_FLOOR = [0.55, 0.52, 0.48];

export class World {
  constructor(width, height) {
    this.width = width;
    this.height = height;
    this.sky = [0, 0, 0];
    /** Discs that shine and block nothing, for soft shadows: { position, radius, color, intensity }. */
    this.lights = [];
    for (const plane of PLANES) this[plane] = new Float32Array(width * height * 3);
    for (let i = 0; i < this.floor.length; i++) this.floor[i] = BARE_FLOOR[i % 3];
  }

  /** From planes of the package's scenes: copied, so that they can be drawn on. */
  static fromPlanes(planes) {
    const world = new World(planes.width, planes.height);
    world.emission.set(planes.emission);
    world.extinction.set(planes.extinction);
    if (planes.albedo) world.albedo.set(planes.albedo);
    if (planes.sky) world.sky = [...planes.sky];
    world.lights = planes.lights ?? [];
    return world;
  }

  isOpaque(pixel) {
    return this.extinction[pixel * 3] === Infinity;
  }

  emits(pixel) {
    const at = pixel * 3;
    return this.emission[at] + this.emission[at + 1] + this.emission[at + 2] > 0;
  }

  /** Makes the pixels of a shape be of a material: { emission, extinction, albedo }. */
  stamp(shape, material) {
    const { emission, extinction, albedo } = material;
    forEachPixel(shape, this.width, this.height, (pixel) => {
      for (let c = 0; c < 3; c++) {
        this.emission[pixel * 3 + c] = emission[c];
        this.extinction[pixel * 3 + c] = extinction[c];
        this.albedo[pixel * 3 + c] = albedo[c];
      }
    });
  }

  /** What stands at a pixel, in a word. */
  nameOf(pixel) {
    if (this.isOpaque(pixel)) return this.emits(pixel) ? "lamp" : "wall";
    const at = pixel * 3;
    const thickness = this.extinction[at] + this.extinction[at + 1] + this.extinction[at + 2];
    return thickness === 0 ? "open" : thickness < 0.15 ? "fog" : "glass";
  }

  /** The same picture at another size: each pixel is the one its centre falls on. */
  resampled(width, height) {
    const result = new World(width, height);
    result.sky = [...this.sky];
    result.lights = this.lights.map((light) => ({
      ...light,
      position: light.position.map((value) => (value * width) / this.width),
      radius: (light.radius * width) / this.width,
    }));
    for (let y = 0; y < height; y++)
      for (let x = 0; x < width; x++) {
        const fromX = Math.floor(((x + 0.5) * this.width) / width);
        const fromY = Math.floor(((y + 0.5) * this.height) / height);
        const from = (fromY * this.width + fromX) * 3,
          to = (y * width + x) * 3;
        for (const plane of PLANES) for (let c = 0; c < 3; c++) result[plane][to + c] = this[plane][from + c];
      }
    const scale = this.width / width; // a pixel covers more or less of the room: media keep their look
    for (let i = 0; i < result.extinction.length; i++) result.extinction[i] *= scale;
    return result;
  }

  /** The planes that a back end reads. */
  planes() {
    const { width, height, emission, extinction, albedo, sky } = this;
    return { width, height, emission, extinction, albedo, sky };
  }

  copy() {
    const result = new World(this.width, this.height);
    result.sky = [...this.sky];
    result.lights = this.lights;
    for (const plane of PLANES) result[plane].set(this[plane]);
    return result;
  }
}
