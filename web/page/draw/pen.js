// What the tools do while the pen is down: freehand paints at once, the others show an outline and paint when it
// is lifted, and a lamp that is carried stays where the pen was pressed without moving. Mouse, touch and keyboard
// all drive this one. Called by pointer.js and keyboard.js.
import { materialOf } from "./materials.js";
import * as shapes from "./shapes.js";

/** A press that moves no further than this is a click [px]. */
const STILL = 2;

const distance = ([ax, ay], [bx, by]) => Math.hypot(bx - ax, by - ay);

/** Tools that draw one shape from where the pen went down to where it was lifted. */
const STRETCHED = {
  line: (from, to, brush) => shapes.capsule(from, to, brush.size / 2),
  rectangle: (from, to, brush) => (brush.filled ? shapes.box(from, to) : shapes.frame(from, to, brush.size)),
  circle: (from, to, brush) =>
    brush.filled
      ? shapes.disc(from[0], from[1], distance(from, to))
      : shapes.ring(from[0], from[1], distance(from, to), brush.size),
};

export class Pen extends EventTarget {
  #drawing;
  #brush;
  #from = null;

  /** `brush` gives what to draw with now: { tool, material, colour, size, brightness, density, filled }. */
  constructor(drawing, brush) {
    super();
    this.#drawing = drawing;
    this.#brush = brush;
  }

  /** Where the pen is, or null when it is away: [x, y] in pixels. */
  at = null;

  get isDown() {
    return this.#from !== null;
  }

  /** Does this tool need two points? */
  get stretches() {
    return this.#brush().tool in STRETCHED;
  }

  /** The outline that would be painted if the pen were lifted now: { tool, from, to }, or null. */
  get outline() {
    return this.isDown && this.stretches ? { tool: this.#brush().tool, from: this.#from, to: this.at } : null;
  }

  down(point) {
    const { tool, material } = this.#brush();
    this.at = this.#from = point;
    this.#drawing.beginStep(`${material} by ${tool}`);
    if (tool === "brush") this.#dab(point, point);
    this.#moved();
  }

  move(point) {
    const before = this.at ?? point;
    this.at = point;
    if (this.isDown && this.#brush().tool === "brush") this.#dab(before, point);
    this.#moved();
  }

  up() {
    if (!this.isDown) return;
    const brush = this.#brush(),
      from = this.#from;
    if (this.stretches) this.#drawing.stamp(STRETCHED[brush.tool](from, this.at, brush), materialOf(brush));
    else if (brush.tool === "carry" && distance(from, this.at) <= STILL) this.#dab(this.at, this.at);
    this.cancel();
  }

  /** Lifts the pen without painting an outline. */
  cancel() {
    if (!this.isDown) return;
    this.#from = null;
    this.#drawing.endStep();
    this.#moved();
  }

  /** The pen leaves the picture. */
  leave() {
    if (this.isDown) return;
    this.at = null;
    this.#moved();
  }

  #dab(from, to) {
    const brush = this.#brush();
    this.#drawing.stamp(shapes.capsule(from, to, brush.size / 2), materialOf(brush));
  }

  #moved() {
    this.dispatchEvent(new Event("move"));
  }
}
