/**
 * Times frames of the back end on the software adapter of headless Chromium, and of the ARC paper's page if its path is
 * given: node web/test/webgpu/bench.mjs [PAGE.html]
 *
 * Both are timed the same way, in turns, in the same browser: from the start of a frame until the device has done all
 * that was submitted. Beside it stands the processor time of the browser's GPU process, which other work on the machine
 * disturbs less. The page is the index.html that was published with the paper; its frames show its own scene, with its ray
 * skipping switched off.
 */
import { copyFileSync } from "node:fs";
import { openBrowser } from "./browser.mjs";

const ROUNDS = Number(process.env.ROUNDS ?? 3);
const FRAMES = Number(process.env.FRAMES ?? 5); // of a round

const ALL_CASES = [
  { name: "holographic", settings: { solver: "holographic" } },
  { name: "cascades, bilinear", settings: { solver: "cascades", merge: "bilinear" } },
  { name: "cascades, bilinear, auto", settings: { solver: "cascades", merge: "bilinear", skip: "auto" } },
  { name: "cascades, bilinear-fix", settings: { solver: "cascades", merge: "bilinear-fix" } },
];

/** ONLY=text in the environment: those whose name has it. */
const CASES = ALL_CASES.filter(({ name }) => name.includes(process.env.ONLY ?? ""));

/** In the page: a world like the paper's scenes. */
async function prepareOurs() {
  const { openWebgpu } = await import("/web/webgpu/index.js");
  const { paperLike } = await import("/web/test/webgpu/scenes.mjs");
  const { worldOf } = await import("/web/test/webgpu/scene.mjs");
  globalThis.world = worldOf(paperLike(512, 512));
  globalThis.backend = await openWebgpu({ shaders: "/shaders/" });
  return backend.detail;
}

/** In the page: lets the paper's page draw a frame only when it is told to, and says when the device has done it. */
function holdFrames() {
  let device;
  let next;
  const requestDevice = GPUAdapter.prototype.requestDevice;
  GPUAdapter.prototype.requestDevice = async function (...given) {
    device = await requestDevice.apply(this, given);
    return device;
  };
  globalThis.requestAnimationFrame = (callback) => {
    next = callback;
    return 0;
  };
  globalThis.drawFrame = async () => {
    next(performance.now());
    await device.queue.onSubmittedWorkDone();
  };
}

async function openTiming({ browser, page }) {
  const session = await browser.newBrowserCDPSession();
  const processorSeconds = async () => {
    const { processInfo } = await session.send("SystemInfo.getProcessInfo");
    return processInfo.filter(({ type }) => type === "GPU").reduce((sum, { cpuTime }) => sum + cpuTime, 0);
  };
  /** Milliseconds a frame: by the clock, and of the GPU process. */
  return async (frames, draw, argument) => {
    const [begin, start] = [await processorSeconds(), performance.now()];
    for (let i = 0; i < frames; i++) await page.evaluate(draw, argument);
    const clock = (performance.now() - start) / frames;
    return { clock, processor: (1000 * ((await processorSeconds()) - begin)) / frames };
  };
}

const drawOurs = (settings) => backend.solve(world, settings).then(() => {});
const drawTheirs = () => drawFrame();

function least(rounds) {
  const of = (kind) => Math.min(...rounds.map((round) => round[kind]));
  return `${of("clock").toFixed(0).padStart(7)} ms by the clock, ${of("processor").toFixed(0).padStart(6)} ms of processor`;
}

/** How many times as long the paper's page took, round by round: the median, and from where to where. */
function times(rounds, theirs, kind) {
  const ratios = rounds.map((round, i) => theirs[i][kind] / round[kind]).sort((a, b) => a - b);
  const middle = (ratios.length - 1) / 2;
  const median = (ratios[Math.floor(middle)] + ratios[Math.ceil(middle)]) / 2;
  return `${median.toFixed(2)} (${ratios[0].toFixed(2)} .. ${ratios.at(-1).toFixed(2)})`;
}

/** Frames of the paper's page, with skipping off. */
async function timeTheirs(opened, time) {
  await opened.page.goto(`${opened.url}out/page.html`);
  await opened.page.waitForFunction(() => globalThis.drawFrame && document.getElementById("arcBtn"));
  await opened.page.waitForTimeout(1000);
  await opened.page.click("#arcBtn");
  await time(1, drawTheirs);
  return time(FRAMES, drawTheirs);
}

async function main(paperPage) {
  const opened = await openBrowser();
  try {
    const time = await openTiming(opened);
    await opened.page.addInitScript(holdFrames);
    if (paperPage) copyFileSync(paperPage, `${opened.out}/page.html`);
    const rounds = new Map([...CASES, { name: "the paper's page" }].map(({ name }) => [name, []]));
    for (let round = 0; round < ROUNDS; round++) {
      if (paperPage) rounds.get("the paper's page").push(await timeTheirs(opened, time));
      await opened.page.goto(opened.url);
      const detail = await opened.page.evaluate(prepareOurs);
      if (round === 0) console.log(`${detail}, least of ${ROUNDS} rounds of ${FRAMES} frames, 512 x 512:`);
      for (const { name, settings } of CASES) {
        await time(1, drawOurs, settings);
        rounds.get(name).push(await time(FRAMES, drawOurs, settings));
      }
    }
    for (const [name, found] of rounds) if (found.length > 0) console.log(`${name.padEnd(26)}${least(found)}`);
    const theirs = rounds.get("the paper's page");
    if (theirs.length === 0) return;
    console.log("the paper's page took so many times as long, median of the rounds: by the clock, of processor");
    for (const { name } of CASES) {
      const ratio = (kind) => times(rounds.get(name), theirs, kind).padEnd(22);
      console.log(`${name.padEnd(26)}${ratio("clock")}${ratio("processor")}`);
    }
  } finally {
    await opened.close();
  }
}

await main(process.argv[2]);
