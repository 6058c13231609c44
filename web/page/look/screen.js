// The canvas: paints the chosen view of a frame, pixel by pixel, and the glow behind it. Called by the loop.
import { VIEWS } from "./views.js";

/** Size of the glow's picture: it is stretched and blurred by the style sheet. */
const GLOW = 24;

export class Screen {
  #context;
  #glow;
  #image = null;

  constructor(canvas, glow) {
    this.canvas = canvas;
    this.#context = canvas.getContext("2d", { alpha: false });
    glow.width = glow.height = GLOW;
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
    this.#glow.drawImage(this.canvas, 0, 0, GLOW, GLOW);
    return performance.now() - begin;
  }
}
