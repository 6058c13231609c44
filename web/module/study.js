// A study's records as the table that `dapple study` writes. Used by pages that offer it for download.

const PROFILES = ["paper", "corrected"];
const MODES = ["off", "L5", "L4", "L3", "L2", "auto"];
const HEADER = "seed,scene,lights,occluders,profile,mode,used_mode,rays_full,rays_traced,reduction,signal_rays," +
  "rays_traced_dead_dropped,reduction_dead_dropped,same_picture_dead_dropped,psnr_display_vs_off," +
  "psnr_linear_vs_off,psnr_display_vs_truth,psnr_linear_vs_truth,rel_rmse_vs_truth";

function number(value, decimals) {
  return Number.isNaN(value) ? "" : value === Infinity ? "inf" : value.toFixed(decimals);
}

function row(record, profile, mode) {
  const of = (name) => record[`${profile}.${mode}.${name}`], off = mode === "off";
  const reduction = (traced) => (1 - traced / of("full")).toFixed(6), dropped = of("dropped");
  return [
    record.seed, record.index, record.lights, record.occluders, profile, mode, MODES[of("used")],
    of("full"), of("traced"), reduction(of("traced")), of("signal_rays"),
    ...(dropped < 0 ? ["", "", ""] : [dropped, reduction(dropped), of("same")]),
    off ? "" : number(of("display_off"), 4), off ? "" : number(of("linear_off"), 4),
    number(of("display_truth"), 4), number(of("linear_truth"), 4), number(of("rel_rmse_truth"), 6),
  ].join(",");
}

/** results.csv of `dapple study`: a row for each scene, profile and mode. */
export function studyTable(records) {
  const rows = records.flatMap((r) => PROFILES.flatMap((p) => MODES.map((m) => row(r, p, m))));
  return [HEADER, ...rows, ""].join("\n");
}
