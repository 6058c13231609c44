// Ways to look at a drawing and its light, each a function that fills RGBA bytes. Called by screen.js.
//
// `frame`: { world, light, truth, exposure, bounced, side }; light and truth are planes of mean radiance, or null while
// there are none; bounced: walls reflect; side: of tiles whose pixels are alike, or 0. Opaque pixels show what they send out as they are drawn now, not when the
// light was solved: so a stroke is seen at once, however slow the solver.
import { toDisplay } from "../draw/colour.js";
import { toneCurve } from "./tone.js";

/** How much the difference view magnifies the difference of bytes. */
const DIFFERENCE_GAIN = 8;

const BYTE_OF_LINEAR = Uint8ClampedArray.from({ length: 1025 }, (_, i) => 255 * toDisplay(i / 1024));
const byteOf = (linear) => BYTE_OF_LINEAR[Math.round(Math.min(Math.max(linear, 0), 1) * 1024)];

/** Fills every pixel with what colour(pixel, channel) says. */
function fill(rgba, pixels, colour) {
  for (let pixel = 0; pixel < pixels; pixel++) {
    for (let c = 0; c < 3; c++) rgba[pixel * 4 + c] = colour(pixel, c);
    rgba[pixel * 4 + 3] = 255;
  }
}

function light(rgba, { world, light: plane, exposure, bounced }) {
  const tone = toneCurve(exposure),
    { emission, extinction } = world;
  fill(rgba, world.width * world.height, (pixel, c) => {
    const at = pixel * 3 + c;
    if (extinction[pixel * 3] !== Infinity) return tone(plane ? plane[at] : 0);
    return tone(bounced && plane ? Math.max(emission[at], plane[at]) : emission[at]);
  });
}

/** The floor under the light; walls take a rim from the light before them, which is for looking only. */
function lit(rgba, { world, light: plane, exposure, side }) {
  const tone = toneCurve(exposure),
    { width, height, emission, extinction, albedo, floor } = world;
  const open = (x, y) => x >= 0 && y >= 0 && x < width && y < height && extinction[(y * width + x) * 3] !== Infinity;
  const reach = side || Math.max(Math.round(width / 128), 1);
  const rim = (x, y, c) => {
    let sum = 0;
    for (const [dx, dy] of [
      [reach, 0],
      [-reach, 0],
      [0, reach],
      [0, -reach],
    ])
      if (open(x + dx, y + dy)) sum = Math.max(sum, plane[((y + dy) * width + x + dx) * 3 + c]);
    return sum;
  };
  fill(rgba, width * height, (pixel, c) => {
    const at = pixel * 3 + c;
    if (!plane) return tone(emission[at]);
    if (extinction[pixel * 3] !== Infinity) return tone(plane[at] * floor[at]);
    const x = pixel % width,
      y = (pixel / width) | 0;
    return tone(emission[at] + (0.06 + albedo[at]) * rim(x, y, c));
  });
}

function emission(rgba, { world, exposure }) {
  const tone = toneCurve(exposure);
  fill(rgba, world.width * world.height, (pixel, c) => tone(world.emission[pixel * 3 + c]));
}

/** White: walls; lamps in their colour; media in the colour that white light has after 10 px, the stronger the
 * thicker they are. */
function walls(rgba, { world }) {
  const { extinction, emission: sent } = world;
  const left = (at) => Math.exp(-10 * extinction[at]);
  fill(rgba, world.width * world.height, (pixel, c) => {
    const first = pixel * 3,
      at = first + c;
    if (world.isOpaque(pixel)) return world.emits(pixel) ? byteOf(0.25 + 0.75 * Math.min(sent[at], 1)) : 232;
    const strength = Math.sqrt(1 - Math.min(left(first), left(first + 1), left(first + 2)));
    return byteOf(0.006 + strength * (0.02 + 0.5 * left(at)));
  });
}

/** The difference of what is displayed, magnified; grey where both are the same walls. */
function difference(rgba, { world, light: plane, truth }) {
  const tone = toneCurve(0);
  if (!truth || !plane || truth.length !== plane.length) return fill(rgba, world.width * world.height, () => 12);
  fill(rgba, world.width * world.height, (pixel, c) => {
    if (world.isOpaque(pixel)) return 40;
    const at = pixel * 3 + c;
    return Math.min(DIFFERENCE_GAIN * Math.abs(tone(plane[at]) - tone(truth[at])), 255);
  });
}

export const VIEWS = { light, lit, emission, walls, difference };
