/** What the cones of holographic radiance cascades weigh (src/holographic/lens.c). Used by holographic.js. */

/** Angle of a ray of a level, from the gather axis. */
function angleOf(level, ray) {
  const reach = 2 ** level;
  return Math.atan2(2 * ray - reach, reach);
}

function widthOf(level, cone) {
  return angleOf(level, cone + 1) - angleOf(level, cone);
}

/** Cone i of level n, at 2^n + i: its share of the cone of the level below that it lies in. */
export function weightsOf(levels) {
  const weights = new Float32Array(2 ** (levels + 1));
  weights[1] = 1;
  for (let level = 1; level <= levels; level++)
    for (let cone = 0; cone < 2 ** level; cone++)
      weights[2 ** level + cone] = widthOf(level, cone) / widthOf(level - 1, cone >> 1);
  return weights;
}
