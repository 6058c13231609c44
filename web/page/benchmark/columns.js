// The benchmark's numbers as rows of text. A record is what the package's study() gives for a scene: numbers
// under names like "paper.L4.traced". Called by dialog.js and chart.js.

const MODES = ["off", "L5", "L4", "L3", "L2", "auto"];

/** The mode that auto chose. */
export function chosenMode(record, profile) {
  return MODES[record[`${profile}.auto.used`]];
}

/** Like the command: "inf" for no error, nothing where there is no such number. */
function number(value, decimals) {
  if (Number.isNaN(value)) return "";
  return value === Infinity ? "inf" : value.toFixed(decimals);
}

/** The correlations as lines under a head of their own. */
export function correlationsCsv(correlations) {
  const lines = correlations.map((c) => {
    const figures = [...[c.r, c.low, c.high].map((value) => number(value, 6)), c.p.toPrecision(6)];
    return [c.profile, c.signal, `${c.quality}_vs_off`, c.count, ...figures].join(",");
  });
  return ["profile,signal,with_L2_mode,scenes,r,low95,high95,p", ...lines, ""].join("\n");
}

const decibels = (value) => (value === Infinity ? "∞" : value.toFixed(1));
const leftOut = (record, profile) => 1 - record[`${profile}.auto.traced`] / record[`${profile}.auto.full`];
const percent = (share) => `${(100 * share).toFixed(1)} %`;
const SKIPPING = MODES.slice(1);

/** Columns of the table: [head, text(record, profile)]. */
export const COLUMNS = [
  ["Scene", (record) => String(record.index)],
  ["Lights", (record) => String(record.lights)],
  ["Occluders", (record) => String(record.occluders)],
  ["Score", (record, profile) => record[`${profile}.signals.score`].toFixed(3)],
  ["Auto chose", chosenMode],
  ["Rays left out", (record, profile) => percent(leftOut(record, profile))],
  ...SKIPPING.map((mode) => [
    `${mode === "auto" ? "Auto" : mode}, dB`,
    (record, profile) => decibels(record[`${profile}.${mode}.display_off`]),
  ]),
  ["Off vs truth, dB", (record, profile) => decibels(record[`${profile}.off.display_truth`])],
];

const mean = (values) => values.reduce((sum, value) => sum + value, 0) / values.length;
const least = (values) => Math.min(...values);

/** What stands under the table: means over the scenes, and the lowest. Scenes without any error do not count. */
export function summary(records, profile) {
  const quality = (name, of) => {
    const values = records.map((record) => record[`${profile}.${name}`]).filter(Number.isFinite);
    return values.length ? of(values).toFixed(1) : "–";
  };
  const names = [...SKIPPING.map((mode) => `${mode}.display_off`), "off.display_truth"];
  const qualities = (of) => names.map((name) => quality(name, of));
  const left = percent(mean(records.map((record) => leftOut(record, profile))));
  return [
    ["Mean", "", "", "", "", left, ...qualities(mean)],
    ["Lowest", "", "", "", "", "", ...qualities(least)],
  ];
}
