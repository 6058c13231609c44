/** In which directions a pixel sees those near it (src/holographic/rims.c). Used by picture.js. */

/** As shaders/look.wgsl says. */
const NEAR = 7;
const SIDE = 2 * NEAR + 1;
const DIRECTIONS = 120;

const WORD = 32;
const WORDS = 4;

/** Does a ray in this direction meet the pixel (x, y) away? It passes its centre nearer than its corners lie. */
function isMet(along, down, x, y) {
  const corner = 0.5 * (Math.abs(along) + Math.abs(down));
  return along * x + down * y > 0 && Math.abs(along * y - down * x) < corner;
}

/** Four words for each pixel near, by rows: a bit for each direction in which it is seen. */
export function sightsNear() {
  const sights = new Uint32Array(WORDS * SIDE * SIDE);
  for (let i = 0; i < DIRECTIONS; i++) {
    const angle = ((i + 0.5) * 2 * Math.PI) / DIRECTIONS;
    for (let place = 0; place < SIDE * SIDE; place++)
      if (isMet(Math.cos(angle), Math.sin(angle), (place % SIDE) - NEAR, Math.floor(place / SIDE) - NEAR))
        sights[WORDS * place + Math.floor(i / WORD)] |= 1 << (i % WORD);
  }
  return sights;
}
