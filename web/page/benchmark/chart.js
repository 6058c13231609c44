// The cloud of scenes: score across, PSNR of L2 upwards, coloured by the mode that auto chose. Called by
// dialog.js; the numbers in it stand in the table too.
import { chosenMode } from "./columns.js";

const SVG = "http://www.w3.org/2000/svg";
const WIDTH = 420,
  HEIGHT = 240,
  LEFT = 44,
  BOTTOM = 36,
  TOP = 12,
  RIGHT = 12;
/** Colours of L5, L4, L3 and whatever else was used. */
const COLOURS = { L5: "#4db8ff", L4: "#ffb95e", L3: "#ff6f91" };

function element(name, attributes, text = "") {
  const made = document.createElementNS(SVG, name);
  for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, value);
  made.textContent = text;
  return made;
}

/** Round steps that cover a range: about `count` of them. */
function ticks(least, most, count) {
  const raw = Math.max((most - least) / count, 1e-9),
    power = 10 ** Math.floor(Math.log10(raw));
  const step = [1, 2, 5, 10].map((factor) => factor * power).find((candidate) => candidate >= raw);
  const result = [];
  for (let at = Math.ceil(least / step) * step; at <= most + 1e-9; at += step) result.push(Number(at.toPrecision(10)));
  return result;
}

export function drawChart(svg, records, profile) {
  const points = records
    .map((record) => ({
      x: record[`${profile}.signals.score`],
      y: record[`${profile}.L2.display_off`],
      mode: chosenMode(record, profile),
    }))
    .filter(({ y }) => Number.isFinite(y));
  svg.setAttribute("viewBox", `0 0 ${WIDTH} ${HEIGHT}`);
  if (points.length === 0) return svg.replaceChildren();
  const most = Math.max(...points.map((p) => p.x), 0.5);
  const low = Math.floor(Math.min(...points.map((p) => p.y)) / 5) * 5;
  const high = Math.ceil(Math.max(...points.map((p) => p.y), low + 5) / 5) * 5;
  const x = (value) => LEFT + (value / most) * (WIDTH - LEFT - RIGHT);
  const y = (value) => HEIGHT - BOTTOM - ((value - low) / (high - low)) * (HEIGHT - BOTTOM - TOP);
  const parts = [];
  for (const value of ticks(low, high, 5)) {
    parts.push(element("line", { x1: LEFT, x2: WIDTH - RIGHT, y1: y(value), y2: y(value), class: "grid" }));
    parts.push(element("text", { x: LEFT - 7, y: y(value) + 4, "text-anchor": "end" }, String(value)));
  }
  const middle = { "text-anchor": "middle" };
  for (const value of ticks(0, most, 6))
    parts.push(element("text", { x: x(value), y: HEIGHT - BOTTOM + 16, ...middle }, String(value)));
  parts.push(element("text", { x: (LEFT + WIDTH) / 2, y: HEIGHT - 4, ...middle }, "score: mean + deviation"));
  parts.push(element("text", { x: LEFT + 4, y: TOP + 4 }, "PSNR of L2, dB"));
  Object.entries(COLOURS).forEach(([mode, fill], i) => {
    parts.push(element("circle", { cx: WIDTH - 150 + i * 50, cy: TOP, r: 4, fill }));
    parts.push(element("text", { x: WIDTH - 142 + i * 50, y: TOP + 4 }, mode));
  });
  for (const point of points) {
    const fill = COLOURS[point.mode] ?? "#fff";
    parts.push(element("circle", { cx: x(point.x), cy: y(point.y), r: 4, fill, class: "point" }));
  }
  svg.replaceChildren(...parts);
}
