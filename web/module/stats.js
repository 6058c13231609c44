// From the numbers of dpl_web_stats() (web/wasm/solve.h) to the Stats of backend.d.ts. Used by session.js.

/** In the order of web/wasm/solve.c. */
export const STATS_NUMBERS = ["levelCount", "raysFull", "raysTraced", "fieldMs", "solveMs", "memoryBytes",
  "skipMode", "measured", "mean", "stddev", "score", "non_zero", "peak_to_average", "bandwidth90", "signalRays"];
export const LEVEL_NUMBERS = ["probes", "directions", "raysFull", "raysTraced"];
export const MAX_LEVELS = 12;

const MODES = ["off", "L5", "L4", "L3", "L2", "auto", "custom", "exact", "bounded"];
const SIGNALS = ["mean", "stddev", "non_zero", "peak_to_average", "bandwidth90"];

function named(names, values, first) {
  return Object.fromEntries(names.map((name, i) => [name, values[first + i]]));
}

/** `skips`: the solver knows ray skipping. */
export function readStats(values, skips, drawMs) {
  const head = named(STATS_NUMBERS, values, 0), levels = [];
  for (let n = 0; n < head.levelCount; n++)
    levels.push(named(LEVEL_NUMBERS, values, STATS_NUMBERS.length + n * LEVEL_NUMBERS.length));
  const measured = head.measured !== 0;
  const skip = {
    signals: measured ? Object.fromEntries(SIGNALS.map((name) => [name, head[name]])) : {},
    score: measured ? head.score : null,
    chosen: MODES[head.skipMode],
  };
  return {
    levels,
    raysFull: head.raysFull,
    raysTraced: head.raysTraced,
    skip: skips ? skip : null,
    stages: [
      { name: "draw", ms: drawMs },
      { name: "distance", ms: head.fieldMs },
      { name: "solve", ms: head.solveMs },
    ],
  };
}
