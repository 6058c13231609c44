// Undo and redo. A step keeps the tiles it is about to change, or a whole world that was replaced; going back
// swaps them with what is there now, which makes the step its own opposite. Called by drawing.js.
import { PLANES } from "./world.js";
import { pixelBounds } from "./shapes.js";

const TILE = 32;
/** Bytes of steps to keep; the oldest go first. */
const MOST_BYTES = 128 * 1024 * 1024;

export class History {
  #past = [];
  #future = [];
  #open = null;

  get canUndo() {
    return this.#past.length > 0;
  }

  get canRedo() {
    return this.#future.length > 0;
  }

  /** Begins a step: what changes until close() goes back together. */
  open(name) {
    this.#open = { name, tiles: new Map(), world: null, bytes: 0 };
  }

  /** Call before pixels within bounds change. */
  keep(world, bounds) {
    const [left, top, right, bottom] = pixelBounds(bounds, world.width, world.height);
    for (let ty = Math.floor(top / TILE); ty * TILE < bottom; ty++)
      for (let tx = Math.floor(left / TILE); tx * TILE < right; tx++) {
        const key = `${tx},${ty}`;
        if (this.#open.tiles.has(key)) continue;
        const tile = copyTile(world, tx * TILE, ty * TILE);
        this.#open.tiles.set(key, tile);
        this.#open.bytes += tile.bytes;
      }
  }

  /** Call before the whole world is replaced by another. */
  keepWorld(world) {
    this.#open.world = world;
    this.#open.bytes = world.width * world.height * 3 * 4 * PLANES.length;
  }

  close() {
    const step = this.#open;
    this.#open = null;
    if (step.tiles.size === 0 && !step.world) return;
    this.#past.push(step);
    this.#future = [];
    let bytes = this.#past.reduce((sum, kept) => sum + kept.bytes, 0);
    while (bytes > MOST_BYTES && this.#past.length > 1) bytes -= this.#past.shift().bytes;
  }

  /** Both return { world, name }: the world to go on with and the step's name; or null. */
  undo(world) {
    return this.#swap(this.#past, this.#future, world);
  }

  redo(world) {
    return this.#swap(this.#future, this.#past, world);
  }

  #swap(from, to, world) {
    const step = from.pop();
    if (!step) return null;
    to.push(step);
    if (step.world) {
      const before = step.world;
      step.world = world;
      return { world: before, name: step.name };
    }
    for (const tile of step.tiles.values()) swapTile(world, tile);
    return { world, name: step.name };
  }
}

function copyTile(world, left, top) {
  const width = Math.min(TILE, world.width - left),
    height = Math.min(TILE, world.height - top);
  const planes = PLANES.map((plane) => {
    const copy = new Float32Array(width * height * 3);
    for (let y = 0; y < height; y++) {
      const at = ((top + y) * world.width + left) * 3;
      copy.set(world[plane].subarray(at, at + width * 3), y * width * 3);
    }
    return copy;
  });
  return { left, top, width, height, planes, bytes: width * height * 3 * 4 * PLANES.length };
}

function swapTile(world, tile) {
  const now = copyTile(world, tile.left, tile.top);
  PLANES.forEach((plane, p) => {
    for (let y = 0; y < tile.height; y++) {
      const row = tile.planes[p].subarray(y * tile.width * 3, (y + 1) * tile.width * 3);
      world[plane].set(row, ((tile.top + y) * world.width + tile.left) * 3);
    }
  });
  tile.planes = now.planes;
}
