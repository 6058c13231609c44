// Letters as strokes of a pen, for neon signs: no font is needed, and they are the same everywhere. Called by
// presets.js.
//
// A letter lives in a box of 6 x 10; a stroke is a list of points joined by straight lines.

/** Points of a half circle that bulges to the right, from (x, top) to (x, bottom). */
function bow(x, top, bottom, reach) {
  const middle = (top + bottom) / 2,
    radius = (bottom - top) / 2;
  return Array.from({ length: 9 }, (_, i) => {
    const angle = -Math.PI / 2 + (i * Math.PI) / 8;
    return [x + reach * Math.cos(angle), middle + radius * Math.sin(angle)];
  });
}

const LETTERS = {
  D: [
    [
      [0, 0],
      [0, 10],
    ],
    [[0, 0], ...bow(2, 0, 10, 4), [0, 10]],
  ],
  A: [
    [
      [0, 10],
      [3, 0],
      [6, 10],
    ],
    [
      [1.2, 6.2],
      [4.8, 6.2],
    ],
  ],
  P: [
    [
      [0, 0],
      [0, 10],
    ],
    [[0, 0], ...bow(3, 0, 5, 3), [0, 5]],
  ],
  L: [
    [
      [0, 0],
      [0, 10],
      [5.5, 10],
    ],
  ],
  E: [
    [
      [5.5, 0],
      [0, 0],
      [0, 10],
      [5.5, 10],
    ],
    [
      [0, 5],
      [4.5, 5],
    ],
  ],
};

/** Widths of letters with the gap behind them. */
const ADVANCE = 8.2;

/** Lines [from, to] of a text whose box begins at (left, top), `unit` pixels a unit; by letter. */
export function linesOfText(text, left, top, unit) {
  return [...text].map((letter, at) =>
    LETTERS[letter].flatMap((stroke) => {
      const points = stroke.map(([x, y]) => [left + (at * ADVANCE + x) * unit, top + y * unit]);
      return points.slice(1).map((to, i) => [points[i], to]);
    }),
  );
}

/** The width of a text in units. */
export function widthOfText(text) {
  return text.length * ADVANCE - 2.2;
}
