// The lamp that is carried: it is not part of the drawing, but put in for as long as a frame is read and taken
// out again. Called by the frame loop.
import { forEachPixel, disc } from "./shapes.js";
import { materialOf } from "./materials.js";

/** Where a lantern that nobody holds is: it wanders on a figure that takes minutes to come back. */
export function wanderingPlace(now, size) {
  const t = now / 1000;
  return [size * (0.5 + 0.4 * Math.sin(t * 0.61)), size * (0.5 + 0.4 * Math.sin(t * 0.43 + 1))];
}

/** At least one pixel. */
export function lanternRadius(brush) {
  return Math.max(brush.size / 2, 0.75);
}

const PUT_IN = ["emission", "extinction", "albedo"];

/** Runs action() with a lantern at `at` in the world; the world is as before afterwards. */
export function withLantern(world, at, brush, action) {
  const shape = disc(at[0], at[1], lanternRadius(brush));
  const pixels = [];
  forEachPixel(shape, world.width, world.height, (pixel) => pixels.push(pixel));
  const before = PUT_IN.map((plane) => pixels.map((pixel) => world[plane].slice(pixel * 3, pixel * 3 + 3)));
  world.stamp(shape, materialOf({ ...brush, material: "lamp" }));
  try {
    return action();
  } finally {
    PUT_IN.forEach((plane, p) => pixels.forEach((pixel, i) => world[plane].set(before[p][i], pixel * 3)));
  }
}
