/**
 * The ARC paper's modes of ray skipping, and the signals that `auto` chooses one by (src/cascade/skip.c, signal.c,
 * choose.c; docs/algorithms/signals.md has the formulas). Used by cascades.js.
 */
import { BRANCHING } from "./schedule.js";

/** By mode: the level where skipping starts, and the most bits; arcStep() in shaders/skip.wgsl obeys them. */
export const SKIP_RULES = {
  off: { startLevel: 0, maxBits: 0 },
  L5: { startLevel: 4, maxBits: 2 },
  L4: { startLevel: 3, maxBits: 1 },
  L3: { startLevel: 3, maxBits: 2 },
  L2: { startLevel: 2, maxBits: 2 },
};

const THRESHOLDS = [0.45, 1.0];

/** What `auto` does about a score. */
export function chooseMode(score) {
  if (!(score >= THRESHOLDS[0])) return "L5";
  return score < THRESHOLDS[1] ? "L4" : "L3";
}

/* ---- where light is looked at -------------------------------------------------------------------- */

const RING_SAMPLES = 16;
const RING_RAYS = RING_SAMPLES * BRANCHING;
const POINTS_ALONG = 8; // of a grid all over the picture

/** Most rays that segmentsOf() makes. */
export const SIGNAL_RAYS = POINTS_ALONG * POINTS_ALONG * RING_RAYS;

/** Points of the grid that do not stand in walls. */
export function signalPoints(width, height, isOpaque) {
  const points = [];
  for (let i = 0; i < POINTS_ALONG * POINTS_ALONG; i++) {
    const x = (((i % POINTS_ALONG) + 0.5) * width) / POINTS_ALONG;
    const y = ((Math.floor(i / POINTS_ALONG) + 0.5) * height) / POINTS_ALONG;
    if (!isOpaque(Math.floor(x), Math.floor(y))) points.push([x, y]);
  }
  return points;
}

/** Rays of the rings around points, from where level 1 begins to the end of the world: start and end of each. */
export function segmentsOf(points, from, diagonal) {
  const out = new Float32Array(4 * RING_RAYS * points.length);
  let at = 0;
  for (const [x, y] of points)
    for (let k = 0; k < RING_RAYS; k++) {
      const angle = (2 * Math.PI * (k + 0.5)) / RING_RAYS;
      const [dx, dy] = [Math.cos(angle), Math.sin(angle)];
      for (const reach of [from, from + diagonal]) {
        out[at++] = x + dx * reach;
        out[at++] = y + dy * reach;
      }
    }
  return out;
}

/** Samples of each ring, r + g + b, from what its rays saw: radiance and what passed, four floats each. */
export function ringsOf(seen, sky) {
  const rings = [];
  for (let ray = 0; 8 * ray < seen.length; ray++) {
    if (ray % RING_RAYS === 0) rings.push(new Array(RING_SAMPLES).fill(0));
    let sum = 0;
    for (let c = 0; c < 3; c++) sum += seen[8 * ray + c] + seen[8 * ray + 4 + c] * sky[c];
    rings.at(-1)[Math.floor((ray % RING_RAYS) / BRANCHING)] += sum / BRANCHING;
  }
  return rings;
}

/* ---- signals of a ring ---------------------------------------------------------------------------- */

const NON_ZERO_ABOVE = 0.01;
const AVERAGE_ABOVE = 0.001;
const ENERGY_SHARE = 0.9;
const ENERGY_ROUNDING = 1e-9;

/** |sum s_j exp(-2 pi i j k / n)|^2 */
function energyAt(ring, k) {
  let [real, imaginary] = [0, 0];
  ring.forEach((sample, j) => {
    const angle = (2 * Math.PI * k * j) / ring.length;
    real += sample * Math.cos(angle);
    imaginary += sample * Math.sin(angle);
  });
  return real * real + imaginary * imaginary;
}

/** Share of the lower half of the spectrum that holds 90 % of its energy. */
function bandwidth90(ring) {
  const energies = Array.from({ length: Math.ceil(ring.length / 2) }, (_, k) => energyAt(ring, k));
  const total = energies.reduce((sum, energy) => sum + energy, 0);
  const squares = ring.length * ring.reduce((sum, sample) => sum + sample * sample, 0);
  if (total <= ENERGY_ROUNDING * squares) return 1;
  let left = (ENERGY_SHARE - ENERGY_ROUNDING) * total;
  const k = energies.findIndex((energy) => (left -= energy) <= 0);
  return (k + 1) / energies.length;
}

function signalsOfRing(ring) {
  const mean = ring.reduce((sum, sample) => sum + sample, 0) / ring.length;
  const variance = ring.reduce((sum, sample) => sum + (sample - mean) ** 2, 0) / ring.length;
  const stddev = Math.sqrt(variance);
  return {
    mean,
    stddev,
    score: mean + stddev,
    non_zero: ring.filter((sample) => sample > NON_ZERO_ABOVE).length / ring.length,
    peak_to_average: mean <= AVERAGE_ABOVE ? 1 : Math.max(...ring) / mean,
    bandwidth90: bandwidth90(ring),
  };
}

/** Mean of the signals over rings; without any, those of darkness. */
export function signalsOf(rings) {
  if (rings.length === 0) return signalsOfRing(new Array(RING_SAMPLES).fill(0));
  const all = rings.map(signalsOfRing);
  const mean = (name) => all.reduce((sum, signals) => sum + signals[name], 0) / all.length;
  return Object.fromEntries(Object.keys(all[0]).map((name) => [name, mean(name)]));
}
