// The ARC paper's 50 scenes, measured here: a form, a bar, a table that grows, correlations and CSV files. Runs
// the very code of `dapple study` in a worker of its own, so that drawing goes on. Called by main.
import { openWasm, studyTable } from "../light/package.js";
import { download } from "../ui/files.js";
import { COLUMNS, correlationsCsv, summary } from "./columns.js";
import { drawChart } from "./chart.js";

/** Signals for people, with the r that the paper gives. */
const SIGNALS = {
  lights: ["light count", "0.81"],
  mean: ["mean", "0.77"],
  mean_stddev: ["mean + deviation (the score)", "0.73"],
  stddev: ["deviation", "0.69"],
  non_zero: ["non-zero ratio", "0.20"],
  peak_to_average: ["peak / average", "-0.60"],
  bandwidth90: ["90 % bandwidth", "-0.68"],
};

function row(texts, head = "td") {
  const made = document.createElement("tr");
  texts.forEach((text, i) => {
    const cell = document.createElement(i === 0 ? "th" : head);
    cell.scope = head === "th" ? "col" : i === 0 ? "row" : "";
    cell.textContent = text;
    made.append(cell);
  });
  return made;
}

export class Benchmark {
  #dialog;
  #records = [];
  #correlations = [];
  #running = null;
  #backend = null; // opened by the first run

  constructor(dialog) {
    this.#dialog = dialog;
    this.#find("table").tHead.append(
      row(
        COLUMNS.map(([head]) => head),
        "th",
      ),
    );
    this.#find("form").addEventListener("submit", (event) => {
      event.preventDefault();
      this.#run();
    });
    this.#find("stop").addEventListener("click", () => this.#running?.abort());
    this.#find("close").addEventListener("click", () => dialog.close());
    dialog.addEventListener("close", () => this.#running?.abort());
    for (const radio of dialog.querySelectorAll("[name=benchmark-profile]"))
      radio.addEventListener("change", () => this.#show());
    this.#find("csv").addEventListener("click", () => this.#save(studyTable(this.#records), "results.csv"));
    this.#find("correlations-csv").addEventListener("click", () =>
      this.#save(correlationsCsv(this.#correlations), "correlations.csv"),
    );
  }

  open() {
    this.#dialog.showModal();
  }

  #find(name) {
    return this.#dialog.querySelector(`#benchmark-${name}`);
  }

  #save(text, name) {
    download(new Blob([text], { type: "text/csv" }), name);
  }

  #say(text) {
    this.#find("status").textContent = text;
  }

  async #run() {
    const [seed, scenes, size, truth] = ["seed", "scenes", "size", "truth"].map((name) =>
      Number(this.#find(name).value),
    );
    const running = new AbortController(),
      begin = performance.now();
    this.#running = running;
    this.#records = [];
    this.#correlations = [];
    this.#busy(true);
    try {
      this.#backend ??= openWasm();
      const { correlations } = await (
        await this.#backend
      ).study(
        { seed, scenes, size, truth },
        {
          signal: running.signal,
          progress: (done) => (this.#find("progress").value = done),
          scene: (record) => this.#add(record, scenes),
        },
      );
      this.#correlations = correlations;
      this.#find("progress").value = 1;
      this.#show();
      this.#say(`Done: ${scenes} scenes in ${((performance.now() - begin) / 1000).toFixed(0)} s.`);
    } catch (error) {
      const done = this.#records.length;
      if (!running.signal.aborted) this.#backend = null; // the next run gets a new one
      this.#say(
        running.signal.aborted
          ? `Stopped after ${done} of ${scenes} scenes.`
          : `The benchmark failed: ${error.message}`,
      );
    }
    this.#running = null;
    this.#busy(false);
  }

  #busy(busy) {
    this.#find("start").hidden = busy;
    this.#find("stop").hidden = !busy;
    if (busy) this.#find("progress").value = 0;
  }

  #add(record, scenes) {
    this.#records.push(record);
    this.#say(`${this.#records.length} of ${scenes} scenes.`);
    this.#show();
  }

  #show() {
    const profile = this.#dialog.querySelector("[name=benchmark-profile]:checked").value;
    this.#find("results").hidden = this.#records.length === 0;
    if (this.#records.length === 0) return;
    const table = this.#find("table");
    const rows = this.#records.map((record) => row(COLUMNS.map(([, text]) => text(record, profile))));
    table.tBodies[0].replaceChildren(...rows);
    table.tFoot.replaceChildren(...summary(this.#records, profile).map((texts) => row(texts)));
    this.#find("correlations-csv").disabled = this.#correlations.length === 0;
    const shown = this.#correlations.filter((c) => c.profile === profile && c.quality === "psnr_display");
    this.#find("correlations").replaceChildren(...shown.map((c) => this.#correlationRow(c)));
    drawChart(this.#find("chart"), this.#records, profile);
  }

  /** With fewer than four scenes there is no interval; the paper's r is of its own 50. */
  #correlationRow({ signal, r, low, high }) {
    const [name, paper] = SIGNALS[signal];
    const text = (value) => (Number.isFinite(value) ? value.toFixed(2) : "–");
    return row([name, text(r), Number.isFinite(low) ? `${text(low)} … ${text(high)}` : "–", paper]);
  }
}
