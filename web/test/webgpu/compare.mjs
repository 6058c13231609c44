/** How far a solution is from the library's own picture of the same scene. Runs in the page. */

/** Differences below this share of the mean count for nothing: far from all light there is only rounding. */
const FLOOR = 0.01;
const DIFFERS_FROM = 1e-3;

/** A PFM of three channels as rows from the top. */
export function readPfm(bytes) {
  const text = new TextDecoder("latin1").decode(bytes.slice(0, 64));
  const [head, width, height, scale] = /^PF\n(\d+) (\d+)\n(-?[\d.]+)\n/.exec(text);
  if (!(Number(scale) < 0)) throw new Error("not a little-endian PFM");
  const rows = new Float32Array(bytes.slice(head.length));
  const out = new Float32Array(rows.length);
  for (let y = 0; y < height; y++) {
    const from = 3 * width * (height - 1 - y);
    out.set(rows.subarray(from, from + 3 * width), 3 * width * y);
  }
  return { width: Number(width), height: Number(height), light: out };
}

/**
 * @returns {{relRmse: number, differing: number, walls: number, pixels: number}} rms of the difference / mean of the
 * reference, and the share of pixels that differ by more than 1e-3 in some channel, both over free pixels; pixels of
 * walls that are not equal to the bit
 */
export function compare(light, reference, extinction) {
  const free = [];
  let walls = 0;
  for (let i = 0; i < light.length; i += 3) {
    const channels = [i, i + 1, i + 2];
    if (!channels.every((c) => extinction[c] === Infinity)) free.push(i);
    else walls += channels.some((c) => light[c] !== reference[c]);
  }
  const sum = (term) => free.reduce((total, i) => total + term(i) + term(i + 1) + term(i + 2), 0);
  const mean = sum((i) => reference[i]) / (3 * free.length);
  const square = sum((i) => (light[i] - reference[i]) ** 2) / (3 * free.length);
  const differs = (i) => !(Math.abs(light[i] - reference[i]) <= DIFFERS_FROM * Math.max(reference[i], FLOOR * mean));
  const differing = free.filter((i) => differs(i) || differs(i + 1) || differs(i + 2)).length;
  return { relRmse: Math.sqrt(square) / mean, differing: differing / free.length, walls, pixels: free.length };
}
