// Frames in which little changes: a lamp that is dragged through a scene of one of the families, in the open or in a
// closed room. Used by reuse.mjs and by the tests in node.

function paint({ width, height, emission, extinction }, inside, light, opaque) {
  for (let y = 0; y < height; y++)
    for (let x = 0; x < width; x++)
      if (inside(x + 0.5, y + 0.5)) {
        emission.fill(light, 3 * (y * width + x), 3 * (y * width + x) + 3);
        extinction.fill(opaque ? Infinity : 0, 3 * (y * width + x), 3 * (y * width + x) + 3);
      }
}

/** Frame `number` of a scene's world; `room`: in a closed room, a sixth of the picture wide. The planes are new. */
export function movingWorld(scene, room, number) {
  const { width, height, sky } = scene;
  const world = { width, height, sky, emission: scene.emission.slice(), extinction: scene.extinction.slice() };
  const centre = 0.4 * width, half = width / 12, turn = 0.15 * number;
  const lamp = { x: centre + 0.03 * width * Math.cos(turn), y: centre + 0.03 * width * Math.sin(turn) };
  const away = (x, y) => Math.max(Math.abs(x - centre), Math.abs(y - centre));
  if (room) {
    paint(world, (x, y) => away(x, y) < half + 2, 0, true);
    paint(world, (x, y) => away(x, y) < half - 2, 0, false);
  }
  paint(world, (x, y) => Math.hypot(x - lamp.x, y - lamp.y) < Math.max(0.008 * width, 1), 2, true);
  return world;
}
