// The part of the panel about the truth: start, cancel, progress, and the figures. Called by main.

/** Rays per pixel from which the truth errs less than what is judged by it. */
const FINE = 1024;

const NOTES = {
  none: () => "Brute force, in a worker of its own.",
  running: () => "Tracing…",
  cancelled: () => "Cancelled.",
  failed: (truth) => `The truth could not be traced: ${truth.error}`,
  done: (truth) =>
    truth.directions < FINE ? "With so few rays the truth itself is grainy: take 1024 or more for figures." : "",
};

function decibels(value) {
  return value === Infinity ? "equal" : `${value.toFixed(1)} dB`;
}

/** What compare() gives, in the order it is shown. */
const FIGURES = [
  ["PSNR, as displayed", (judged) => decibels(judged.psnrDisplay)],
  ["PSNR, linear", (judged) => decibels(judged.psnrLinear)],
  ["relative RMSE", (judged) => judged.relRmse.toFixed(4)],
  ["SSIM", (judged) => judged.ssim.toFixed(4)],
];

export class TruthPanel {
  #find;
  #truth;
  #asked = 0;

  constructor(root, truth, start) {
    this.#find = (id) => root.querySelector(`#${id}`);
    this.#truth = truth;
    this.#find("truth-start").addEventListener("click", start);
    this.#find("truth-cancel").addEventListener("click", () => truth.cancel());
  }

  /** Shows how far the truth is. `light`: of the last frame, or null. */
  show(light) {
    const truth = this.#truth,
      running = truth.state === "running";
    this.#find("truth-start").hidden = running;
    this.#find("truth-cancel").hidden = !running;
    this.#find("truth-progress").hidden = !running;
    this.#find("truth-progress").firstElementChild.value = truth.done;
    const note = NOTES[truth.state](truth);
    this.#find("truth-note").textContent = note;
    this.#find("truth-note").hidden = note === "";
    if (truth.state === "done" && light) this.#judge(light);
    else this.#find("truth-table").hidden = true;
  }

  async #judge(light) {
    const asked = ++this.#asked,
      judged = await this.#truth.judge(light);
    if (asked !== this.#asked || !judged || this.#truth.state !== "done") return;
    this.#find("truth-table").hidden = false;
    this.#find("truth-figures").replaceChildren(...FIGURES.map(([name, text]) => this.#row(name, text(judged))));
  }

  #row(name, text) {
    const row = document.createElement("tr"),
      head = document.createElement("th"),
      cell = document.createElement("td");
    Object.assign(head, { scope: "row", textContent: name });
    cell.textContent = text;
    row.append(head, cell);
    return row;
  }
}
