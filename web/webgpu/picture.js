/** From the sums of the quadrants to the picture, on the device: docs/web.md. Used by holographic.js. */
import { groupsFor } from "./plan.js";
import { sightsNear } from "./sights.js";

/** The tiles that shaders/mean.wgsl goes by, and the rows that shaders/finish.wgsl takes at once. */
const TILE = [64, 4];
const ROWS = 8;

/** Pixels of a word of shaders/sets.wgsl, and bytes of its two sets. */
const WORD = 32;
const SETS_BYTES = 8;

/** Most invocations that go through the list of pixels beside lamps, per lane. */
const LISTED = 1024;

/** The mean of the quadrants of every pixel, filtered. */
function filterSteps(kit, { size, emission, sums, means, light, width, height }) {
  return [
    {
      kernel: "mean",
      entry: "mean",
      bindings: { 0: size, 1: emission, 2: sums[0], 3: sums[1], 4: means, 10: kit.nearest },
      groups: [Math.ceil(width / TILE[0]), Math.ceil(height / TILE[1]), 1],
    },
    {
      kernel: "finish",
      entry: "show",
      bindings: { 0: size, 1: emission, 2: means, 4: light, 10: kit.nearest },
      groups: groupsFor(width * Math.ceil(height / ROWS)),
    },
  ];
}

/** The same anew for pixels beside lamps ("Rims"), which are listed first. */
function rimSteps(kit, plan, { size, emission, occupied, means, listed, light, width, height }) {
  const words = Math.ceil(width / WORD) * height;
  const sets = plan.buffer("sets", SETS_BYTES * words);
  const near = plan.buffer("light near", 16 * width * height);
  const list = { 8: listed, 9: plan.buffer("listed", 4 * width * height) };
  const everyWord = groupsFor(words);
  const everyListed = groupsFor(Math.min(width * height, LISTED * kit.lanes));
  return [
    {
      kernel: "mark",
      entry: "mark",
      bindings: { 0: size, 1: emission, 5: sets, 6: occupied },
      groups: everyWord,
    },
    {
      kernel: "list",
      entry: "list",
      bindings: { 0: size, 5: sets, ...list },
      groups: everyWord,
    },
    {
      kernel: "look",
      entry: "look",
      bindings: { 0: size, 1: emission, 2: plan.constant("sights", sightsNear()), 5: sets, 7: near, ...list },
      groups: everyListed,
    },
    {
      kernel: "rims",
      entry: "mend",
      bindings: { 0: size, 2: means, 4: light, 7: near, ...list, 10: kit.nearest },
      groups: everyListed,
    },
  ];
}

/**
 * @param {object} shown `size` and `emission` of the world; `occupied`, of its rows; `sums` of both axes; `means`, a texture to work
 *   in; `listed`, a count that is 0 when a run begins; `light`, where it all goes; `width` and `height` [px]
 */
export function pictureSteps(kit, plan, shown) {
  const steps = [...filterSteps(kit, shown), ...rimSteps(kit, plan, shown)];
  return Promise.all(steps.map((step) => plan.step({ stage: "picture", ...step })));
}
