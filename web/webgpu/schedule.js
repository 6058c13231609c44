/** The schedule of radiance cascades, as src/cascade/schedule.c computes it with all defaults. Used by cascades.js. */

const DIRECTIONS = 4; // of a probe of level 0
const INTERVAL = 2; // of level 0 [px]
const MOST_LEVELS = 12;

/** Rays that a slot stands for. */
export const BRANCHING = 4;

function levelCount(diagonal) {
  let count = 1;
  for (let interval = INTERVAL; count < MOST_LEVELS && interval < diagonal; interval *= BRANCHING) count++;
  return count;
}

/**
 * Levels, the lowest first. `furthest` is how far a ray may get from the middle of a block, which holds 2 x 2 probes: those of the
 * fixed merges aim at a parent's ring, which stands up to one and a half spacings aside. `around` is how far a ray may begin from
 * where the middle of its slot's rays would, seen from the middle of the block.
 * @param {"bilinear" | "bilinear-fix" | "nearest-fix"} merge
 */
export function scheduleOf(width, height, merge) {
  const count = levelCount(Math.hypot(width, height));
  return Array.from({ length: count }, (_, number) => {
    const spacing = 2 ** number;
    const probes = [Math.ceil(width / spacing), Math.ceil(height / spacing)];
    const directions = DIRECTIONS * BRANCHING ** number;
    const aims = merge === "bilinear-fix" && number + 1 < count ? 4 : 1;
    return {
      number,
      spacing,
      probes,
      probeCount: probes[0] * probes[1],
      directions,
      slots: directions / BRANCHING,
      t0: number === 0 ? 0 : INTERVAL * BRANCHING ** (number - 1),
      t1: INTERVAL * BRANCHING ** number,
      furthest: INTERVAL * BRANCHING ** number + spacing * (Math.SQRT1_2 + (merge === "bilinear" ? 0 : 1.5 * Math.SQRT2)),
      around: spacing + (Math.PI * INTERVAL) / DIRECTIONS,
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
