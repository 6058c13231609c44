// The live panel: which back end, how long each stage took, rays counted, what skipping saw. Called by main
// after every frame; writes at most five times a second, which is what people can read.

const EVERY = 200; // [ms]

/** Names of signals for people; others appear as they are. */
const SIGNAL_NAMES = {
  mean: "mean",
  stddev: "deviation",
  score: "score",
  non_zero: "non-zero",
  peak_to_average: "peak / average",
  bandwidth90: "90 % bandwidth",
};

function countText(count) {
  if (count >= 1e9) return `${(count / 1e9).toFixed(2)} G`;
  if (count >= 1e6) return `${(count / 1e6).toFixed(2)} M`;
  return count >= 1e4 ? `${(count / 1e3).toFixed(1)} k` : String(count);
}

function make(name, properties = {}, children = []) {
  const element = Object.assign(document.createElement(name), properties);
  element.append(...children);
  return element;
}

/** A table row of a name and a value. */
function row(name, value) {
  return make("tr", {}, [make("th", { scope: "row", textContent: name }), make("td", { textContent: value })]);
}

function stageRow({ name, ms }, longest) {
  const bar = make("span", { className: "bar" });
  bar.style.inlineSize = `${longest > 0 ? (100 * ms) / longest : 0}%`;
  const cell = make("td", {}, [make("span", { className: "bar-room" }, [bar]), `${ms.toFixed(1)} ms`]);
  return make("tr", {}, [make("th", { scope: "row", textContent: name }), cell]);
}

export class Panel {
  #parts;
  #timer = 0;
  #written = 0;
  #latest = null;

  constructor(root) {
    const find = (id) => root.querySelector(`#${id}`);
    this.#parts = {
      backend: find("used-backend"),
      instead: find("used-instead"),
      ms: find("frame-ms"),
      rate: find("frame-rate"),
      stages: find("stages"),
      rays: find("ray-rows"),
      flood: find("flood-rows"),
      levels: find("levels"),
      levelsBox: find("levels-box"),
      signals: find("signals"),
      signalsBox: find("signals-box"),
      chosen: find("chosen"),
      score: find("score"),
    };
  }

  show(last) {
    this.#latest = last;
    this.#parts.stages.ariaBusy = "true";
    const wait = Math.max(this.#written + EVERY - performance.now(), 0);
    this.#timer ||= setTimeout(() => {
      this.#timer = 0;
      this.#written = performance.now();
      this.#write(this.#latest);
      this.#parts.stages.ariaBusy = "false";
    }, wait);
  }

  #write({ solution, backend, instead, ms, paintMs, rate }) {
    const { stats } = solution,
      parts = this.#parts;
    parts.backend.textContent = backend.detail;
    parts.instead.textContent = instead ?? "";
    parts.instead.hidden = !instead;
    parts.ms.textContent = ms.toFixed(ms < 100 ? 1 : 0);
    parts.rate.textContent = rate ? rate.toFixed(rate < 10 ? 1 : 0) : "–";
    const stages = [...stats.stages, { name: "show", ms: paintMs }];
    const longest = Math.max(...stages.map((stage) => stage.ms));
    parts.stages.replaceChildren(...stages.map((stage) => stageRow(stage, longest)));
    this.#writeRays(stats);
    if (stats.flood) this.#writeFlood(stats.flood);
    this.#writeSkip(stats.skip);
  }

  #writeRays({ raysFull, raysTraced, levels }) {
    const saved = raysFull > 0 ? 100 * (1 - raysTraced / raysFull) : 0;
    this.#parts.rays.replaceChildren(
      row("traced", countText(raysTraced)),
      row("without skipping", countText(raysFull)),
      row("left out", `${saved.toFixed(1)} %`),
    );
    this.#parts.levelsBox.hidden = levels.length === 0;
    this.#parts.levels.replaceChildren(
      ...levels.map((level, i) =>
        make("tr", {}, [
          make("th", { scope: "row", textContent: String(i) }),
          ...[level.probes, level.directions, level.raysTraced].map((n) => make("td", { textContent: countText(n) })),
        ]),
      ),
    );
  }

  #writeFlood({ cells, visits, removals, fromScratch }) {
    this.#parts.flood.replaceChildren(
      row("tiles", countText(cells)),
      row("visited", countText(visits)),
      row("darkened first", countText(removals)),
      row("solved", fromScratch ? "from scratch" : "what changed"),
    );
  }

  #writeSkip(skip) {
    this.#parts.signalsBox.hidden = !skip;
    if (!skip) return;
    this.#parts.chosen.textContent = skip.chosen;
    this.#parts.score.textContent = skip.score === null ? "–" : skip.score.toFixed(3);
    const named = Object.entries(skip.signals).filter(([name]) => name !== "score");
    this.#parts.signals.replaceChildren(
      ...named.map(([name, value]) => row(SIGNAL_NAMES[name] ?? name, value.toFixed(3))),
    );
  }
}
