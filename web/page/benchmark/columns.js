// The benchmark's numbers as rows of text: the table on the page, and the same results.csv as `dapple study`
// writes. A record is what the package's study() gives for a scene. Called by dialog.js.

export const PROFILES = ["paper", "corrected"];
export const MODES = ["off", "L5", "L4", "L3", "L2", "auto"];

/** Like the command: "inf" for no error, nothing where there is no such number. */
function number(value, decimals) {
  if (Number.isNaN(value)) return "";
  return value === Infinity ? "inf" : value.toFixed(decimals);
}

const RESULTS_HEAD =
  "seed,scene,lights,occluders,profile,mode,used_mode,rays_full,rays_traced,reduction,signal_rays," +
  "rays_traced_dead_dropped,reduction_dead_dropped,same_picture_dead_dropped,psnr_display_vs_off," +
  "psnr_linear_vs_off,psnr_display_vs_truth,psnr_linear_vs_truth,rel_rmse_vs_truth";

function resultLine(record, profile, mode) {
  const run = record.profiles[profile].modes[mode], isOff = mode === "off";
  const dropped = run.dropped < 0 ? ["", "", ""] : [run.dropped, number(1 - run.dropped / run.full, 6), run.same];
  return [
    record.seed, record.index, record.lights, record.occluders, profile, mode, MODES[run.used], run.full, run.traced,
    number(1 - run.traced / run.full, 6), run.signal_rays, ...dropped,
    isOff ? "" : number(run.display_off, 4), isOff ? "" : number(run.linear_off, 4),
    number(run.display_truth, 4), number(run.linear_truth, 4), number(run.rel_rmse_truth, 6),
  ].join(",");
}

/** results.csv of `dapple study`. */
export function resultsCsv(records) {
  const lines = records.flatMap((record) =>
    PROFILES.flatMap((profile) => MODES.map((mode) => resultLine(record, profile, mode))),
  );
  return [RESULTS_HEAD, ...lines, ""].join("\n");
}

/** The correlations as lines under a head of their own. */
export function correlationsCsv(correlations) {
  const lines = correlations.map((c) =>
    [c.profile, c.signal, `${c.quality}_vs_off`, c.count, number(c.r, 6), number(c.low, 6), number(c.high, 6), c.p.toPrecision(6)].join(","),
  );
  return ["profile,signal,with_L2_mode,scenes,r,low95,high95,p", ...lines, ""].join("\n");
}

const decibels = (value) => (value === Infinity ? "∞" : value.toFixed(1));
const percent = (run) => `${(100 * (1 - run.traced / run.full)).toFixed(1)} %`;

/** Columns of the table: [head, text(record, profile)]. */
export const COLUMNS = [
  ["Scene", (record) => String(record.index)],
  ["Lights", (record) => String(record.lights)],
  ["Occluders", (record) => String(record.occluders)],
  ["Score", (record, profile) => record.profiles[profile].signals.score.toFixed(3)],
  ["Auto chose", (record, profile) => MODES[record.profiles[profile].modes.auto.used]],
  ["Rays left out", (record, profile) => percent(record.profiles[profile].modes.auto)],
  ...["L5", "L4", "L3", "L2", "auto"].map((mode) => [
    mode === "auto" ? "Auto, dB" : `${mode}, dB`,
    (record, profile) => decibels(record.profiles[profile].modes[mode].display_off),
  ]),
  ["Off vs truth, dB", (record, profile) => decibels(record.profiles[profile].modes.off.display_truth)],
];

const finite = (values) => values.filter(Number.isFinite);
const mean = (values) => values.reduce((sum, value) => sum + value, 0) / values.length;

/** What stands under the table: the mean over the scenes and the lowest. */
export function summary(records, profile) {
  const runs = (mode) => records.map((record) => record.profiles[profile].modes[mode]);
  const left = mean(runs("auto").map((run) => 1 - run.traced / run.full));
  const quality = (mode, of) => {
    const values = finite(runs(mode).map((run) => run.display_off));
    return values.length ? of(values).toFixed(1) : "–";
  };
  const modes = ["L5", "L4", "L3", "L2", "auto"];
  return [
    ["Mean", "", "", "", "", `${(100 * left).toFixed(1)} %`, ...modes.map((mode) => quality(mode, mean)), mean(runs("off").map((run) => run.display_truth)).toFixed(1)],
    ["Lowest", "", "", "", "", "", ...modes.map((mode) => quality(mode, (values) => Math.min(...values))), Math.min(...runs("off").map((run) => run.display_truth)).toFixed(1)],
  ];
}
