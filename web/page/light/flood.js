// Light by flood fill, as tile games have it: the drawing becomes cells, walls where at least half of a cell is
// opaque and lights where it emits, and each pixel shows the light of its cell. Called by ways.js.

/** Levels are no radiance. So that a lamp's surroundings are as bright as by other methods: a tile beside a lamp of a
 * tile's size gets asin(1/2) / pi of its radiance. */
const BESIDE_A_LAMP = 1 / 6;

/** Albedo of walls of tiles. */
const STONE = 0.5;

/** Radiance of what emits in a cell, and how many of its pixels are opaque. */
function readCell(world, [x0, y0, x1, y1], colour) {
  let opaque = 0,
    shining = 0;
  colour.fill(0);
  for (let y = y0; y < y1; y++)
    for (let pixel = y * world.width + x0; pixel < y * world.width + x1; pixel++) {
      if (world.isOpaque(pixel)) opaque++;
      if (!world.emits(pixel)) continue;
      shining++;
      for (let c = 0; c < 3; c++) colour[c] += world.emission[pixel * 3 + c];
    }
  for (let c = 0; shining > 0 && c < 3; c++) colour[c] /= shining;
  return opaque;
}

/** A disc of light shines from the cell that its centre is in. */
function addLights(tiles, lights, side) {
  for (const { position, color, intensity } of lights) {
    const [x, y] = position.map((value) => Math.floor(value / side));
    if (x < 0 || y < 0 || x >= tiles.width || y >= tiles.height) continue;
    const at = (y * tiles.width + x) * 3;
    for (let c = 0; c < 3; c++) tiles.lights[at + c] = Math.max(tiles.lights[at + c], color[c] * intensity);
  }
}

/** The drawing as cells of `side` x `side` pixels; the last ones of a row may be cut. */
export function tilesOf(world, side, lights) {
  const width = Math.ceil(world.width / side),
    height = Math.ceil(world.height / side);
  const tiles = { width, height, walls: new Uint8Array(width * height), lights: new Float32Array(width * height * 3) };
  for (let cell = 0; cell < width * height; cell++) {
    const x = (cell % width) * side,
      y = Math.floor(cell / width) * side;
    const box = [x, y, Math.min(x + side, world.width), Math.min(y + side, world.height)];
    const opaque = readCell(world, box, tiles.lights.subarray(cell * 3, cell * 3 + 3));
    tiles.walls[cell] = Number(2 * opaque >= (box[2] - box[0]) * (box[3] - box[1]));
  }
  addLights(tiles, lights, side);
  return tiles;
}

/** Calls visit(pixel, cell) for each pixel of the picture. */
function forEachPixel({ width, height }, tiles, side, visit) {
  for (let y = 0, pixel = 0; y < height; y++) {
    const row = Math.floor(y / side) * tiles.width;
    for (let x = 0; x < width; x++, pixel++) visit(pixel, row + Math.floor(x / side));
  }
}

/** Tiles and their light as pixels: what the views show in place of the drawing. */
function pixelsOf(world, tiles, light, side) {
  const values = world.width * world.height * 3;
  const [pixelLight, emission, extinction, albedo] = Array.from({ length: 4 }, () => new Float32Array(values));
  forEachPixel(world, tiles, side, (pixel, cell) => {
    for (let c = 0; c < 3; c++) {
      const to = pixel * 3 + c,
        from = cell * 3 + c;
      emission[to] = tiles.lights[from];
      pixelLight[to] = Math.max(tiles.lights[from], BESIDE_A_LAMP * light[from]);
      if (!tiles.walls[cell]) continue;
      extinction[to] = Infinity;
      albedo[to] = STONE;
    }
  });
  return { light: pixelLight, emission, extinction, albedo };
}

/** Like a back end's solve(); `asked`: { cell, falloff, range }. Reads the planes before it returns. */
export async function floodLight(backend, world, asked, lights, options) {
  const { width, height } = world,
    { cell: side, falloff, range } = asked,
    begin = performance.now();
  const tiles = tilesOf(world, side, lights),
    drawMs = performance.now() - begin;
  const flooded = await backend.flood(tiles, { falloff, range }, options);
  const { light, ...seen } = pixelsOf({ width, height }, tiles, flooded.light, side);
  const stages = [
    { name: "tiles", ms: drawMs },
    { name: "flood", ms: flooded.stats.ms },
  ];
  const flood = { ...flooded.stats, cells: tiles.width * tiles.height };
  return { width, height, light, seen, side, stats: { levels: [], raysFull: 0, raysTraced: 0, skip: null, stages, flood } };
}
