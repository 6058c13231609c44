/** In which directions a pixel sees those near it (src/holographic/rims.c). Used by holographic.js. */

/** As shaders/rims.wgsl says. */
const NEAR = 7;
const DIRECTIONS = 120;

const TURN = 2 * Math.PI;
const WORD = 32;
const WORDS = 4;

/** The angle as one of half a turn either way. */
function fromMiddle(angle, middle) {
  const difference = angle - middle;
  return difference - TURN * Math.round(difference / TURN);
}

/** Directions in which the pixel (x, y) away is seen, a bit each. */
function sightOf(x, y) {
  const middle = Math.atan2(y, x);
  const corners = [-0.5, 0.5].flatMap((up) => [-0.5, 0.5].map((right) => Math.atan2(y + up, x + right)));
  const sides = corners.map((angle) => fromMiddle(angle, middle));
  const words = new Uint32Array(WORDS);
  for (let i = 0; i < DIRECTIONS; i++) {
    const angle = fromMiddle(((i + 0.5) * TURN) / DIRECTIONS, middle);
    if (angle > Math.min(...sides) && angle < Math.max(...sides)) words[Math.floor(i / WORD)] |= 1 << (i % WORD);
  }
  return words;
}

/** Four words for each pixel near, by rows. */
export function sightsNear() {
  const places = Array.from({ length: 2 * NEAR + 1 }, (_, index) => index - NEAR);
  return Uint32Array.from(places.flatMap((y) => places.flatMap((x) => [...sightOf(x, y)])));
}
