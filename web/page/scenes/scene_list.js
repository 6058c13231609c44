// Every scene there is to begin with: those made by the page, and the families of the library. Called by main
// and the scene picker.
import { World } from "../draw/world.js";
import { paintFloor } from "./floors.js";
import { PRESETS } from "./presets.js";

/** Scenes by name; `family`: of the library, `count` to choose from per seed;
 * `solver`: the one that it is for; `exposure`: what shows it best, where that is not 0. */
export const SCENES = {
  house: { title: "House at night", family: "demo", count: 1, floor: "boards" },
  rooms: { title: "Rooms with doors" },
  pillars: { title: "Pillars and a fire" },
  stained: { title: "Stained glass and mist" },
  neon: { title: "Neon sign" },
  empty: { title: "Empty floor" },
  arc: { title: "ARC paper's benchmark", family: "arc", count: 50, floor: "tiles" },
  maze: { title: "Mazes", family: "maze", count: 10, floor: "bricks" },
  flats: { title: "Rooms with doorways", family: "rooms", count: 10, floor: "boards" },
  thin: { title: "Thin walls", family: "thin", count: 10, floor: "tiles" },
  tiny: { title: "Tiny lights", family: "tiny", count: 10, floor: "tiles", exposure: -2.5 },
  area: { title: "Lights as large as rooms", family: "area", count: 10, floor: "tiles" },
  clutter: { title: "Clutter", family: "clutter", count: 10, floor: "boards" },
  fog: { title: "Fog", family: "fog", count: 10, floor: "boards" },
  discs: { title: "Soft shadows", family: "shadows", count: 12, floor: "tiles", solver: "shadows" },
  painted: { title: "Painted rooms (turn bounces up)", family: "bounce", count: 10, floor: "boards" },
};

/** Makes a scene. `which`: { scene, seed, index, size }; `openLibrary` gives the back end that knows families. */
export async function makeStart({ scene, seed, index, size }, openLibrary) {
  if (scene in PRESETS) return PRESETS[scene](size);
  const { family, count, floor } = SCENES[scene];
  const library = await openLibrary();
  const world = World.fromPlanes(await library.makeScene(family, seed, Math.min(index, count - 1), size, size));
  paintFloor(world, floor);
  return world;
}
