/**
 * Scene files of shapes as worlds: the part of docs/scene-format.md that the scenes here use, without images. Runs in
 * the page.
 */

/** Is a pixel's centre inside? By kind of shape. */
const INSIDE = {
  disc: ({ center, radius }, x, y) => (x - center[0]) ** 2 + (y - center[1]) ** 2 <= radius ** 2,
  box: ({ center, half, angle = 0 }, x, y) => {
    const [c, s] = [Math.cos(angle), Math.sin(angle)];
    const [dx, dy] = [x - center[0], y - center[1]];
    return Math.abs(c * dx + s * dy) <= half[0] && Math.abs(c * dy - s * dx) <= half[1];
  },
};

function colourOf(value) {
  if (value === "opaque") return [Infinity, Infinity, Infinity];
  return typeof value === "number" ? [value, value, value] : value;
}

function draw(world, { emission = 0, extinction = "opaque", ...shape }) {
  const [kind, geometry] = Object.entries(shape).find(([name]) => name in INSIDE);
  const colours = [colourOf(emission), colourOf(extinction)];
  for (let y = 0; y < world.height; y++)
    for (let x = 0; x < world.width; x++) {
      if (!INSIDE[kind](geometry, x + 0.5, y + 0.5)) continue;
      const at = 3 * (y * world.width + x);
      world.emission.set(colours[0], at);
      world.extinction.set(colours[1], at);
    }
}

/** @returns {import("dapple").World} */
export function worldOf({ size: [width, height], sky = 0, shapes = [] }) {
  const plane = () => new Float32Array(3 * width * height);
  const world = { width, height, emission: plane(), extinction: plane(), sky: colourOf(sky) };
  for (const shape of shapes) draw(world, shape);
  return world;
}
