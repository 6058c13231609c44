/** The schedule of radiance cascades, as src/cascade/schedule.c computes it with all defaults. Used by cascades.js. */

const DIRECTIONS = 4; // of a probe of level 0
const INTERVAL = 2; // of level 0 [px]
const MOST_LEVELS = 12;
const ROUNDING = 0.02; // of places in a world [px]

/** Rays that a slot stands for. */
export const BRANCHING = 4;

function levelCount(diagonal) {
  let count = 1;
  for (let interval = INTERVAL; count < MOST_LEVELS && interval < diagonal; interval *= BRANCHING) count++;
  return count;
}

/**
 * A beam that all rays of a slot of a block of 2 x 2 probes stay in: its radius where they begin [px], and by how much it
 * widens. Rays of the fixed merges aim at a parent's ring, which stands up to one and a half spacings aside. Rays of
 * level 0 begin in their probes and go all ways: wherever they go, they get no further than the beam does.
 */
function beamOf(merge, spacing, directions, t0, t1) {
  const angle = t0 === 0 ? 0 : (3 * Math.PI) / directions; // between the slot's middle and its outermost ray
  const aside = merge === "bilinear" ? 0 : 1.5 * Math.SQRT2 * spacing;
  return { radius: spacing * Math.SQRT1_2 + t0 * angle + ROUNDING, widening: angle + aside / (t1 - t0) };
}

/**
 * Levels, the lowest first.
 * @param {"bilinear" | "bilinear-fix" | "nearest-fix"} merge
 */
export function scheduleOf(width, height, merge) {
  const count = levelCount(Math.hypot(width, height));
  return Array.from({ length: count }, (_, number) => {
    const spacing = 2 ** number;
    const probes = [Math.ceil(width / spacing), Math.ceil(height / spacing)];
    const t0 = number === 0 ? 0 : INTERVAL * BRANCHING ** (number - 1);
    const t1 = INTERVAL * BRANCHING ** number;
    const directions = DIRECTIONS * BRANCHING ** number;
    const aims = merge === "bilinear-fix" && number + 1 < count ? 4 : 1;
    return {
      number,
      spacing,
      probes,
      probeCount: probes[0] * probes[1],
      directions,
      slots: directions / BRANCHING,
      t0,
      t1,
      ...beamOf(merge, spacing, directions, t0, t1),
      raysFull: probes[0] * probes[1] * directions * aims,
    };
  });
}

/** Cosine and sine of all levels, one after another, in steps of half a ray. */
export function directionsOf(levels) {
  const total = levels.reduce((sum, level) => sum + 2 * level.directions, 0);
  const out = new Float32Array(2 * total);
  let at = 0;
  for (const { directions } of levels)
    for (let half = 0; half < 2 * directions; half++) {
      const angle = (Math.PI * half) / directions;
      out[at++] = Math.cos(angle);
      out[at++] = Math.sin(angle);
    }
  return out;
}
