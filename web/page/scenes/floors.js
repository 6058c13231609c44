// Patterns for the floor, which the view "lit colours" shows. Called by presets.js.

/** A number 0 .. 1 that belongs to a place: the same on every machine. */
function chance(x, y) {
  let h = (Math.imul(x, 374761393) + Math.imul(y, 668265263)) | 0;
  h = Math.imul(h ^ (h >>> 13), 1274126177);
  return ((h ^ (h >>> 16)) >>> 0) / 4294967296;
}

const mix = (a, b, t) => a.map((value, c) => value + (b[c] - value) * t);

/** Each pattern: the colour of the floor at (x, y) in units of 1/256 of the picture. */
const PATTERNS = {
  boards: (x, y) => {
    const row = Math.floor(y / 12),
      shifted = x + row * 37;
    const seam = y % 12 < 0.8 || shifted % 64 < 0.8;
    const grain =
      chance(Math.floor(shifted / 9), Math.floor(y * 1.5)) * 0.25 + chance(row, Math.floor(shifted / 64)) * 0.5;
    return seam ? [0.1, 0.06, 0.035] : mix([0.4, 0.24, 0.13], [0.72, 0.47, 0.28], grain);
  },
  tiles: (x, y) => {
    const seam = x % 16 < 0.8 || y % 16 < 0.8;
    const dark = (Math.floor(x / 16) + Math.floor(y / 16)) % 2;
    const shade = chance(Math.floor(x / 16), Math.floor(y / 16)) * 0.2;
    return seam ? [0.12, 0.12, 0.13] : mix(dark ? [0.32, 0.34, 0.38] : [0.66, 0.65, 0.62], [0.5, 0.5, 0.5], shade);
  },
  bricks: (x, y) => {
    const row = Math.floor(y / 8),
      shifted = x + (row % 2) * 8;
    const seam = y % 8 < 1 || shifted % 16 < 1;
    const shade = chance(Math.floor(shifted / 16), row);
    return seam ? [0.3, 0.29, 0.28] : mix([0.38, 0.14, 0.09], [0.62, 0.28, 0.2], shade);
  },
};

export function paintFloor(world, pattern) {
  const unit = 256 / world.width,
    colour = PATTERNS[pattern];
  for (let y = 0; y < world.height; y++)
    for (let x = 0; x < world.width; x++)
      world.floor.set(colour((x + 0.5) * unit, (y + 0.5) * unit), (y * world.width + x) * 3);
}
