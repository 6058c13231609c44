// The picture that people work on: one world, its history, and a "change" event for whoever must look again.
// Called by pen, files, scene picker and main.
import { History } from "./history.js";
import { World } from "./world.js";

export class Drawing extends EventTarget {
  #history = new History();
  world = new World(256, 256);
  /** Has anything been drawn since the scene was loaded? */
  edited = false;

  get canUndo() {
    return this.#history.canUndo;
  }

  get canRedo() {
    return this.#history.canRedo;
  }

  /** Strokes of one step go back together. */
  beginStep(name) {
    this.#history.open(name);
  }

  stamp(shape, material) {
    this.#history.keep(this.world, shape.bounds);
    this.world.stamp(shape, material);
    this.edited = true;
    this.#changed();
  }

  endStep() {
    this.#history.close();
    this.#changed();
  }

  /** Puts another world in the place of this one, as a step of its own. */
  replace(world, name, edited) {
    this.#history.open(name);
    this.#history.keepWorld(this.world);
    this.#history.close();
    this.world = world;
    this.edited = edited;
    this.#changed();
  }

  /** Not a step: the sky is not drawn. */
  setSky(rgb) {
    this.world.sky = rgb;
    this.#changed();
  }

  /** The first world: nothing to go back to. */
  start(world) {
    this.world = world;
    this.edited = false;
    this.#changed();
  }

  /** The name of the step that was taken back, or null. */
  undo() {
    return this.#go(this.#history.undo(this.world));
  }

  redo() {
    return this.#go(this.#history.redo(this.world));
  }

  #go(result) {
    if (!result) return null;
    this.world = result.world;
    this.edited = true;
    this.#changed();
    return result.name;
  }

  #changed() {
    this.dispatchEvent(new Event("change"));
  }
}
