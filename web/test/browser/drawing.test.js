// Drawing with mouse, touch and keyboard: what is drawn changes the light, and can be undone.
import assert from "node:assert/strict";
import { execFile } from "node:child_process";
import { mkdtemp, readFile, rm, writeFile } from "node:fs/promises";
import { tmpdir } from "node:os";
import path from "node:path";
import { after, before, test } from "node:test";
import { promisify } from "node:util";
import {
  DAPPLE,
  brightness,
  click,
  decoded,
  drag,
  fill,
  hover,
  openPage,
  openSite,
  pick,
  pictureBytes,
  pixel,
  settled,
} from "./browser.js";

const run = promisify(execFile);
let site;
before(async () => (site = await openSite()));
after(() => site.close());

/** An empty floor with one lamp in the middle. */
const emptyFloor = (options) => site.page("scene=empty", options);

/** A PNG of a white lamp, a black wall, and a pane of brown glass that shines a little. */
async function pngOfLampAndWall(page) {
  const bytes = await page.evaluate(async () => {
    const canvas = new OffscreenCanvas(256, 256),
      context = canvas.getContext("2d");
    context.fillStyle = "#ffffff";
    context.fillRect(60, 120, 16, 16);
    context.fillStyle = "#000000";
    context.fillRect(120, 60, 8, 136);
    context.fillStyle = "#ff880033";
    context.fillRect(20, 30, 90, 20);
    return [...new Uint8Array(await (await canvas.convertToBlob()).arrayBuffer())];
  });
  return Buffer.from(bytes);
}

test("a lamp drawn with the mouse lights what was dark", async () => {
  const page = await emptyFloor();
  await pick(page, "tool", "brush");
  const before = await pixel(page, [40, 60]);
  await page.locator("[aria-label=blue]").click();
  await settled(page, () => drag(page, [30, 30], [60, 30]));
  const after = await pixel(page, [40, 60]);
  assert.ok(after[2] > before[2] + 60, `blue rose from ${before[2]} to ${after[2]}`);
  assert.ok(after[2] > after[0], "the light is blue");
  await page.close();
});

test("a wall drawn with the mouse throws a shadow, undo takes it away and redo brings it back", async () => {
  const page = await emptyFloor();
  await pick(page, "tool", "line");
  await pick(page, "material", "wall");
  const lit = await brightness(page, [220, 128]);
  await settled(page, () => drag(page, [180, 90], [180, 166]));
  const shaded = await brightness(page, [220, 128]);
  assert.ok(shaded < lit / 2, `${lit} became ${shaded}`);
  await settled(page, () => page.click("#undo"));
  assert.equal(await brightness(page, [220, 128]), lit);
  await settled(page, () => page.keyboard.press("Control+y"));
  assert.equal(await brightness(page, [220, 128]), shaded);
  await page.close();
});

test("red glass colours the light behind it, and the eraser removes it", async () => {
  const page = await emptyFloor();
  await pick(page, "tool", "rectangle");
  await pick(page, "material", "glass");
  await page.locator("[aria-label=red]").click();
  await page.getByLabel("Filled").check();
  const before = await pixel(page, [220, 128]);
  await settled(page, () => drag(page, [176, 100], [188, 156]));
  const behind = await pixel(page, [220, 128]);
  assert.ok(behind[2] < before[2] * 0.6 && behind[0] > before[0] * 0.8, `${before} became ${behind}`);
  await pick(page, "material", "eraser");
  await settled(page, () => drag(page, [174, 98], [190, 158]));
  assert.deepEqual(await pixel(page, [220, 128]), before);
  await page.close();
});

test("a carried lamp follows the mouse, and a click leaves it where it is", async () => {
  const page = await emptyFloor();
  const dark = await brightness(page, [60, 40]);
  await settled(page, () => hover(page, [40, 40]));
  const carried = await brightness(page, [60, 40]);
  assert.ok(carried > dark + 60, `${dark} became ${carried}`);
  await settled(page, () => hover(page, [216, 216]));
  assert.ok((await brightness(page, [60, 40])) < carried - 40, "it moved on");
  await settled(page, () => click(page, [40, 216]));
  await settled(page, () => hover(page, [216, 40]));
  assert.ok((await brightness(page, [60, 216])) > dark + 60, "it stays at the corner it was left in");
  await page.close();
});

test("the keyboard alone draws: arrows move, space paints a stroke and a rectangle", async () => {
  const page = await emptyFloor();
  await page.locator("#picture").focus();
  await page.keyboard.press("b");
  for (let i = 0; i < 10; i++) await page.keyboard.press("ArrowUp");
  const before = await brightness(page, [150, 70]);
  await page.keyboard.down(" ");
  for (let i = 0; i < 5; i++) await page.keyboard.press("ArrowRight");
  await settled(page, () => page.keyboard.up(" "));
  assert.ok((await brightness(page, [150, 70])) > before + 30);
  assert.match(await page.textContent("#status"), /lamp|\d+, \d+/);
  await page.keyboard.press("r");
  await page.keyboard.press("2");
  await page.keyboard.press(" ");
  for (let i = 0; i < 6; i++) await page.keyboard.press("ArrowRight");
  for (let i = 0; i < 6; i++) await page.keyboard.press("ArrowDown");
  await settled(page, () => page.keyboard.press(" "));
  await settled(page, () => page.keyboard.press("v")); // lit colours
  assert.ok(await page.locator("input[name=view][value=lit]").isChecked());
  await settled(page, () => pick(page, "view", "walls"));
  assert.ok((await brightness(page, [172, 88])) > 600, "the far edge of the rectangle is a wall");
  await settled(page, () => page.keyboard.press("Control+z"));
  assert.ok((await brightness(page, [172, 100])) < 100, "undone by key");
  await page.close();
});

test("a finger draws", async () => {
  const context = await site.context.browser().newContext({ hasTouch: true, viewport: { width: 390, height: 844 } });
  const page = await openPage(context, site.url, "scene=empty");
  const before = await brightness(page, [40, 60]);
  const box = await page.locator("#picture").boundingBox();
  await settled(page, () => page.touchscreen.tap(box.x + (box.width * 40) / 256, box.y + (box.height * 40) / 256));
  assert.ok((await brightness(page, [40, 60])) > before + 60);
  await page.close();
  await context.close();
});

test("a PNG of a lamp and a wall becomes lamps and walls, and a saved drawing opens as it was", async () => {
  const page = await emptyFloor();
  const made = await pngOfLampAndWall(page);
  await page.setInputFiles("#file", { name: "room-x4.png", mimeType: "image/png", buffer: made });
  assert.equal(await page.inputValue("#open-brightness"), "4", "the name says how bright its lamps are");
  await settled(page, () => page.click("#open-confirm"));
  await page.waitForFunction(() => document.querySelector("#status").textContent.includes("is open"));
  await settled(page);
  const [lit, shaded] = [await brightness(page, [90, 128]), await brightness(page, [160, 128])];
  assert.ok(lit > 300 && shaded < lit / 3, `before the wall ${lit}, behind it ${shaded}`);
  const drawn = await pictureBytes(page);

  await page.click("#save");
  const [download] = await Promise.all([page.waitForEvent("download"), page.click("#save-world")]);
  assert.match(download.suggestedFilename(), /^dapple-drawing-x4\.png$/);
  const saved = await readFile(await download.path());
  await page.locator("#save-dialog [type=submit]").click();
  await settled(page, () => page.click("#reset"));
  await page.setInputFiles("#file", { name: download.suggestedFilename(), mimeType: "image/png", buffer: saved });
  await page.click("#open-confirm");
  await page.waitForFunction(() => document.querySelector("#status").textContent.includes("drawing-x4.png is open"));
  await settled(page);
  assert.ok(drawn.data.equals((await pictureBytes(page)).data), "the same picture, byte for byte");
  await page.close();
});

test("a PNG is lit as dapple render lights it, but for a byte here and there by one", async () => {
  const page = await site.page("scene=empty&sky=%23000000");
  const folder = await mkdtemp(path.join(tmpdir(), "dapple-png-"));
  const [drawn, lit] = ["drawn.png", "lit.png"].map((name) => path.join(folder, name));
  await writeFile(drawn, await pngOfLampAndWall(page));
  await page.setInputFiles("#file", drawn);
  await page.click("#open-confirm");
  await page.waitForFunction(() => document.querySelector("#status").textContent.includes("drawn.png is open"));
  await settled(page);
  await run(DAPPLE, ["render", drawn, "-o", lit]);
  const here = await pictureBytes(page),
    there = await decoded(page, await readFile(lit));
  await rm(folder, { recursive: true });
  const worst = here.data.reduce((most, value, i) => Math.max(most, Math.abs(value - there.data[i])), 0);
  assert.ok(
    here.data.some((value, i) => i % 4 === 0 && value > 200),
    "it is lit",
  );
  assert.ok(worst <= 1, `bytes differ by ${worst}`);
  await page.close();
});

test("what is no picture is refused with a sentence, and the drawing stays", async () => {
  const page = await emptyFloor();
  const before = await pictureBytes(page);
  await page.setInputFiles("#file", { name: "letter.png", mimeType: "image/png", buffer: Buffer.from("Dear page,") });
  await page.click("#open-confirm");
  await page.waitForSelector("#notice:not([hidden])");
  assert.match(await page.textContent("#notice-text"), /letter\.png could not be read/);
  assert.ok(before.data.equals((await pictureBytes(page)).data));
  await page.close();
});

test("another number of pixels keeps what was drawn", async () => {
  const page = await emptyFloor();
  await pick(page, "tool", "brush");
  await settled(page, () => drag(page, [30, 30], [60, 30]));
  const before = await pixel(page, [45, 50]);
  await page.selectOption("#size", "512");
  await page.waitForFunction(() => document.querySelector("#picture").width === 512);
  await settled(page);
  const after = await pixel(page, [45, 50]);
  for (let c = 0; c < 3; c++) assert.ok(Math.abs(before[c] - after[c]) < 12, `${before} became ${after}`);
  await page.close();
});

test("a worker that dies is replaced, and the drawing stays", async () => {
  const context = await site.context.browser().newContext();
  await context.addInitScript(() => {
    globalThis.workers = [];
    globalThis.Worker = class extends Worker {
      constructor(...args) {
        super(...args);
        globalThis.workers.push(this);
      }
    };
  });
  const page = await openPage(context, site.url, "scene=empty&size=128");
  await pick(page, "tool", "brush");
  await settled(page, () => drag(page, [30, 30], [60, 30]));
  const before = await brightness(page, [45, 50]);
  const count = await page.evaluate(() => {
    workers[0].dispatchEvent(new ErrorEvent("error", { message: "out of memory" }));
    return workers.length;
  });
  await page.waitForSelector("#notice:not([hidden])");
  assert.match(await page.textContent("#notice-text"), /The worker was lost.*drawing is as it was/s);
  await page.waitForFunction((count) => workers.length > count, count);
  await settled(page);
  assert.equal(await brightness(page, [45, 50]), before);
  await page.close();
  await context.close();
});

test("exposure brightens the picture without another solve", async () => {
  const page = await emptyFloor();
  const before = await brightness(page, [60, 60]);
  await settled(page, () => fill(page, "exposure", 2));
  assert.ok((await brightness(page, [60, 60])) > before * 1.3);
  await page.close();
});
