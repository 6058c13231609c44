// Choosing a start scene, its size and its sky. Called by main.
import { hexOfLinear, linearOfHex } from "../draw/colour.js";
import { SCENES, makeStart } from "../scenes/scene_list.js";

function which(settings) {
  return {
    scene: settings.get("scene") in SCENES ? settings.get("scene") : "house",
    seed: settings.get("seed"),
    index: settings.get("index"),
    size: settings.get("size"),
  };
}

export class ScenePicker {
  #root;
  #settings;
  #drawing;
  #messages;
  #openLibrary;
  #asked = 0;

  constructor(root, settings, drawing, messages, openLibrary) {
    this.#root = root;
    this.#settings = settings;
    this.#drawing = drawing;
    this.#messages = messages;
    this.#openLibrary = openLibrary;
    const select = root.querySelector("#scene");
    for (const [name, { title }] of Object.entries(SCENES)) select.add(new Option(title, name));
    select.value = settings.get("scene");
    root.querySelector("#reset").addEventListener("click", () => this.load());
    root.querySelector("#sky").addEventListener("input", (event) => settings.set("sky", event.target.value));
    this.#showFields();
  }

  /** Loads the scene that the settings name; `first`: there is nothing yet to go back to. */
  async load(first = false) {
    const asked = ++this.#asked;
    this.#showFields();
    const chosen = which(this.#settings);
    try {
      const world = await makeStart(chosen, this.#openLibrary);
      if (asked !== this.#asked) return; // another scene was asked for meanwhile
      if (this.#settings.get("sky")) world.sky = linearOfHex(this.#settings.get("sky"));
      if (first) this.#drawing.start(world);
      else this.#drawing.replace(world, "scene", false);
      this.#showSky();
    } catch (error) {
      this.#messages.notice(`The scene could not be made: ${error.message}`);
    }
  }

  /** A setting changed: what of it is the scene's? */
  changed(name) {
    if (name === "scene") this.#sceneChosen();
    if (["scene", "seed", "index"].includes(name)) this.load();
    else if (name === "size") this.#resize();
    else if (name === "sky" && this.#settings.get("sky")) {
      this.#drawing.setSky(linearOfHex(this.#settings.get("sky")));
      this.#showSky();
    }
  }

  /** Another scene has another sky and exposure, and may be made for one method. */
  #sceneChosen() {
    const made = SCENES[which(this.#settings).scene].solver ?? "holographic";
    this.#settings.set("sky", "");
    this.#settings.set("exposure", SCENES[which(this.#settings).scene].exposure ?? 0);
    if ((made === "shadows") !== (this.#settings.get("solver") === "shadows")) this.#settings.set("solver", made);
  }

  /** What was drawn stays, in larger or smaller pixels; an untouched scene is made again. */
  #resize() {
    const { world, edited } = this.#drawing,
      size = this.#settings.get("size");
    if (world.width === size && world.height === size) return;
    if (edited) this.#drawing.replace(world.resampled(size, size), "size", true);
    else this.load();
  }

  #showFields() {
    const { scene } = which(this.#settings),
      { family, count } = SCENES[scene];
    this.#root.querySelector("#family-fields").hidden = !(count > 1);
    this.#root.querySelector("#index").max = family ? count - 1 : 0;
  }

  #showSky() {
    this.#root.querySelector("#sky").value = hexOfLinear(this.#drawing.world.sky);
  }
}
