/** Where a world has anything at all, for shaders/near.wgsl and mark.wgsl. Used by holographic.js. */
import { kindAt } from "./world.js";

/** Pixels that share a bit, and bits of a word. */
const UNIT_SHIFT = 2;
const WORD_SHIFT = 5;

/** Words of a line that is as many pixels long, and those of them that shaders/near.wgsl reads at once. */
const AT_ONCE = 4;

export function wordsFor(length) {
  const bits = AT_ONCE << WORD_SHIFT;
  return AT_ONCE * Math.ceil(length / (bits << UNIT_SHIFT));
}

/**
 * A bit for each four pixels of a line, set where any is not empty.
 * @param world as takeWorld() leaves it
 * @returns {[Uint32Array, Uint32Array]} of the world's columns and of its rows: [line][word]
 */
export function occupancyOf(world) {
  const { width, height } = world;
  const columnWords = wordsFor(height);
  const rowWords = wordsFor(width);
  const columns = new Uint32Array(width * columnWords);
  const rows = new Uint32Array(height * rowWords);
  for (let y = 0, pixel = 0; y < height; y++) {
    const down = y >> UNIT_SHIFT;
    for (let x = 0; x < width; x++, pixel++) {
      if (kindAt(world, pixel) === 0) continue; // most are empty
      const along = x >> UNIT_SHIFT;
      columns[x * columnWords + (down >> WORD_SHIFT)] |= 1 << down; // of 32 bits, as shifts are
      rows[y * rowWords + (along >> WORD_SHIFT)] |= 1 << along;
    }
  }
  return [columns, rows];
}
