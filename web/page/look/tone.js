// The curve from mean radiance to display bytes: 1 - 1/(1 + 2 pi m)^2.5, the library's tone map, with an
// exposure before it. Called by views.js. The figures in dB do not come from here but from the library.

const STEPS = 4096;
/** The curve over t = 1 - 1 / (1 + x), which is 0 .. 1 for any radiance: 1 - (1 - t)^2.5. */
const CURVE = Uint8ClampedArray.from({ length: STEPS + 1 }, (_, i) => 255 * (1 - (1 - i / STEPS) ** 2.5));

/** A function from mean radiance to a byte. `exposure` in stops. */
export function toneCurve(exposure) {
  const scale = 2 * Math.PI * 2 ** exposure;
  return (mean) => (mean > 0 ? CURVE[((1 - 1 / (1 + scale * mean)) * STEPS + 0.5) | 0] : 0);
}
