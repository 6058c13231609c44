// PNG in and out. Opening fits the picture into the world, centred; saving gives what is seen, or the drawing
// itself: alpha is wall, colour is lamp, as the command reads it. Called by main.
import { LINEAR_OF_BYTE, toDisplay } from "../draw/colour.js";
import { World } from "../draw/world.js";

/** Darker than this (mean of the sRGB bytes) is wall, where a picture is read as walls alone. */
const DARK = 96;

/** Pixels of an image file, fitted into size x size: ImageData. */
async function pixelsOf(file, size) {
  const image = await createImageBitmap(file, { colorSpaceConversion: "none" });
  const scale = Math.min(size / image.width, size / image.height);
  const width = Math.max(Math.round(image.width * scale), 1),
    height = Math.max(Math.round(image.height * scale), 1);
  const canvas = new OffscreenCanvas(size, size),
    context = canvas.getContext("2d");
  context.imageSmoothingEnabled = scale < 1; // smaller: mixed; larger: pixels stay pixels
  context.drawImage(image, Math.round((size - width) / 2), Math.round((size - height) / 2), width, height);
  image.close();
  return context.getImageData(0, 0, size, size);
}

/** How a pixel of a picture becomes one of a world; colours and alpha are bytes, `brightness` is of lamps. */
const READINGS = {
  world(world, pixel, rgb, alpha, brightness) {
    const at = pixel * 3;
    const extinction = alpha === 255 ? Infinity : -Math.log(1 - alpha / 255);
    for (let c = 0; c < 3; c++) {
      world.extinction[at + c] = extinction;
      world.emission[at + c] = alpha > 0 ? LINEAR_OF_BYTE[rgb[c]] * brightness : 0;
    }
  },
  walls(world, pixel, rgb, alpha) {
    if (alpha > 127 && (rgb[0] + rgb[1] + rgb[2]) / 3 < DARK) world.extinction.fill(Infinity, pixel * 3, pixel * 3 + 3);
  },
  floor(world, pixel, rgb) {
    for (let c = 0; c < 3; c++) world.floor[pixel * 3 + c] = LINEAR_OF_BYTE[rgb[c]];
  },
};

/** The world that a file and a way of reading it make; floors and walls are laid into the drawing as it is. */
export async function worldOfFile(file, reading, brightness, before) {
  const size = before.width;
  const { data } = await pixelsOf(file, size);
  const world = reading === "floor" ? before.copy() : new World(size, size);
  world.sky = [...before.sky];
  if (reading !== "floor") world.floor.set(before.floor);
  for (let pixel = 0; pixel < size * size; pixel++) {
    const at = pixel * 4;
    READINGS[reading](world, pixel, [data[at], data[at + 1], data[at + 2]], data[at + 3], brightness);
  }
  return world;
}

/** The drawing as RGBA; `brightness`: what its brightest lamp was divided by. */
export function drawingImage(world) {
  const { width, height, emission, extinction } = world;
  const brightness = Math.max(
    1,
    emission.reduce((most, value) => Math.max(most, value), 0),
  );
  const image = new ImageData(width, height);
  for (let pixel = 0; pixel < width * height; pixel++) {
    const mean = (extinction[pixel * 3] + extinction[pixel * 3 + 1] + extinction[pixel * 3 + 2]) / 3;
    for (let c = 0; c < 3; c++) image.data[pixel * 4 + c] = 255 * toDisplay(emission[pixel * 3 + c] / brightness);
    // Only what is opaque may have alpha 255: a dense medium stays a medium.
    image.data[pixel * 4 + 3] = mean === Infinity ? 255 : Math.min(255 * (1 - Math.exp(-mean)), 254);
  }
  return { image, brightness };
}

export async function savePng(source, name) {
  const canvas = new OffscreenCanvas(source.width, source.height),
    context = canvas.getContext("2d");
  if (source instanceof ImageData) context.putImageData(source, 0, 0);
  else context.drawImage(source, 0, 0);
  download(await canvas.convertToBlob({ type: "image/png" }), name);
}

export function download(blob, name) {
  const link = Object.assign(document.createElement("a"), { href: URL.createObjectURL(blob), download: name });
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10000);
}
