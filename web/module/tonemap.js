// The tone map of dpl_tonemap(), to the byte, for pages to show light with.

/**
 * v = 1 - 1/(1 + 2 pi m)^2.5 per channel, m the mean radiance; RGBA for ImageData. `exposure` scales m first.
 */
export function tonemap(light, exposure = 1) {
  const pixels = light.length / 3, out = new Uint8ClampedArray(4 * pixels), f = Math.fround;
  const turn = f(6.28318531), scale = f(exposure);
  for (let i = 0, at = 0; i < pixels; i++, at += 4) {
    for (let c = 0; c < 3; c++) {
      const m = f(light[3 * i + c] * scale), x = m > 0 ? m : 0; // also for not-a-number
      const base = f(1 + f(turn * x)), power = f(f(base * base) * f(Math.sqrt(base)));
      out[at + c] = Math.floor(f(f(f(1 - f(1 / power)) * 255) + 0.5));
    }
    out[at + 3] = 255;
  }
  return out;
}
