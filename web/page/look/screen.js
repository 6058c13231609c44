// The canvas: paints the chosen view of a frame, pixel by pixel, and the glow behind it. Called by the loop.
import { VIEWS } from "./views.js";

/** The glow is a small picture of the canvas, blurred into a margin, that the style sheet stretches: so it costs
 * next to nothing, also where there is no graphics card. Sizes in its own pixels. */
const GLOW = { inside: 48, margin: 12, filter: "blur(4px) saturate(1.3)" };

export class Screen {
  #context;
  #glow;
  #image = null;

  constructor(canvas, glow) {
    this.canvas = canvas;
    this.#context = canvas.getContext("2d", { alpha: false });
    glow.width = glow.height = GLOW.inside + 2 * GLOW.margin;
    this.#glow = glow.getContext("2d");
  }

  /** Paints; returns how long it took [ms]. */
  paint(view, frame) {
    const begin = performance.now();
    const { width, height } = frame.world;
    if (!this.#image || this.#image.width !== width || this.#image.height !== height) {
      this.canvas.width = width;
      this.canvas.height = height;
      this.#image = this.#context.createImageData(width, height);
    }
    VIEWS[view](this.#image.data, frame);
    this.#context.putImageData(this.#image, 0, 0);
    this.#paintGlow();
    return performance.now() - begin;
  }
  #paintGlow() {
    const { inside, margin, filter } = GLOW;
    this.#glow.clearRect(0, 0, inside + 2 * margin, inside + 2 * margin);
    this.#glow.filter = filter;
    this.#glow.drawImage(this.canvas, margin, margin, inside, inside);
  }
}
