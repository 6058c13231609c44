// What can be drawn: lamps, walls, glass, fog, and nothing. Each makes the values of a pixel from the brush's
// colour and sliders. Called by pen, lantern and scenes.
import { linearOfHex } from "./colour.js";

const OPAQUE = [Infinity, Infinity, Infinity];
const NOTHING = [0, 0, 0];
/** Glass lets at least this much of each colour through one "density" of it, so that no colour is endless. */
const LEAST_TRANSMITTED = 0.01;

/** Materials by name; `amount` is the slider that matters to it, or null. */
export const MATERIALS = {
  lamp: {
    amount: "brightness",
    make: (brush) => ({
      emission: linearOfHex(brush.colour).map((c) => c * brush.brightness),
      extinction: OPAQUE,
      albedo: NOTHING,
    }),
  },
  wall: {
    amount: null,
    make: (brush) => ({ emission: NOTHING, extinction: OPAQUE, albedo: linearOfHex(brush.colour).map((c) => c * 0.9) }),
  },
  glass: {
    amount: "density",
    make: (brush) => ({
      emission: NOTHING,
      // Light that crossed 10 px of density 1 has the brush's colour.
      extinction: linearOfHex(brush.colour).map(
        (c) => (-Math.log(Math.max(c, LEAST_TRANSMITTED)) * brush.density) / 10,
      ),
      albedo: NOTHING,
    }),
  },
  fog: {
    amount: "density",
    make: (brush) => ({
      emission: NOTHING,
      extinction: linearOfHex(brush.colour).map((c) => 0.02 * brush.density * (1.3 - 0.6 * c)),
      albedo: NOTHING,
    }),
  },
  eraser: { amount: null, make: () => ({ emission: NOTHING, extinction: NOTHING, albedo: NOTHING }) },
};

/** The pixel values that a brush paints. */
export function materialOf(brush) {
  return MATERIALS[brush.material].make(brush);
}
