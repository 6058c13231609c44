/** What the cones of holographic radiance cascades weigh (src/holographic/lens.c). Used by holographic.js. */

/** Angle of a ray of a level, from the gather axis. */
function angleOf(level, ray) {
  const reach = 2 ** level;
  return Math.atan2(2 * ray - reach, reach);
}

function widthOf(level, cone) {
  return angleOf(level, cone + 1) - angleOf(level, cone);
}

/** For cone i of level n, at 2 (2^n + i): the shares of it that its two cones of the level above have. */
export function weightsOf(levels) {
  const weights = new Float32Array(2 ** (levels + 1));
  for (let level = 0; level < levels; level++)
    for (let cone = 0; cone < 2 ** level; cone++)
      for (const s of [0, 1])
        weights[2 * (2 ** level + cone) + s] = widthOf(level + 1, 2 * cone + s) / widthOf(level, cone);
  return weights;
}
