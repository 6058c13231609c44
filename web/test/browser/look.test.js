// How the page looks: screenshots of its states against stored ones, both shrunk, so that another font or a
// driver does not matter but a broken layout or a missing picture does. UPDATE=1 stores what is seen.
import assert from "node:assert/strict";
import { existsSync } from "node:fs";
import { mkdir, readFile, writeFile } from "node:fs/promises";
import path from "node:path";
import { after, before, test } from "node:test";
import { openSite, pick, settled } from "./browser.js";

const FOLDER = path.join(import.meta.dirname, "pictures");
/** Mean difference of bytes that is allowed, and the share of bytes that may differ by more than FAR. */
const MEAN = 6,
  SHARE = 0.05,
  FAR = 40;
const SHRINK = 4;

let site;
before(async () => (site = await openSite()));
after(() => site.close());

/** A PNG as { width, height, data, png }: RGBA bytes after shrinking, decoded by the browser itself. */
async function shrunk(page, png, factor) {
  const result = await page.evaluate(
    async ([text, factor]) => {
      const bytes = Uint8Array.from(atob(text), (c) => c.charCodeAt(0));
      const image = await createImageBitmap(new Blob([bytes], { type: "image/png" }));
      const canvas = new OffscreenCanvas(Math.round(image.width / factor), Math.round(image.height / factor));
      const context = canvas.getContext("2d", { willReadFrequently: true });
      context.imageSmoothingQuality = "high";
      context.drawImage(image, 0, 0, canvas.width, canvas.height);
      const base64 = (array) => btoa(Array.from(array, (b) => String.fromCharCode(b)).join(""));
      const made = new Uint8Array(await (await canvas.convertToBlob()).arrayBuffer());
      return {
        width: canvas.width,
        height: canvas.height,
        data: base64(context.getImageData(0, 0, canvas.width, canvas.height).data),
        png: base64(made),
      };
    },
    [png.toString("base64"), factor],
  );
  return { ...result, data: Buffer.from(result.data, "base64"), png: Buffer.from(result.png, "base64") };
}

async function looksAsStored(page, name) {
  // Times change from run to run.
  const seen = await shrunk(
    page,
    await page.screenshot({
      animations: "disabled",
      mask: [page.locator("#stages, .figures, #status")],
      maskColor: "#11141b",
    }),
    SHRINK,
  );
  const file = path.join(FOLDER, `${name}.png`);
  if (process.env.UPDATE === "1") {
    await mkdir(FOLDER, { recursive: true });
    await writeFile(file, seen.png);
  }
  assert.ok(existsSync(file), `${file} is missing: UPDATE=1 stores it`);
  const stored = await shrunk(page, await readFile(file), 1);
  assert.deepEqual([seen.width, seen.height], [stored.width, stored.height]);
  let sum = 0,
    far = 0;
  for (let i = 0; i < seen.data.length; i++) {
    const apart = Math.abs(seen.data[i] - stored.data[i]);
    sum += apart;
    if (apart > FAR) far++;
  }
  const mean = sum / seen.data.length,
    share = far / seen.data.length;
  assert.ok(mean <= MEAN && share <= SHARE, `${name}: mean ${mean.toFixed(2)}, ${(100 * share).toFixed(2)} % far`);
}

for (const [name, hash, view] of [
  ["house", "", "light"],
  ["pillars-lit", "scene=pillars", "lit"],
  ["stained-walls", "scene=stained", "walls"],
])
  test(`the scene ${name} looks as stored`, async () => {
    const page = await site.page(hash);
    await pick(page, "view", view);
    await settled(page);
    await page.waitForSelector("#webgpu-note:not([hidden])");
    await page.waitForTimeout(300);
    await looksAsStored(page, name);
    await page.close();
  });

test("a phone looks as stored", async () => {
  const page = await site.page("scene=neon&view=lit", { width: 390, height: 844 });
  await settled(page);
  await looksAsStored(page, "phone");
  await page.close();
});

test("the help and the benchmark look as stored", async () => {
  const page = await site.page("scene=empty");
  await page.waitForSelector("#webgpu-note:not([hidden])");
  await page.click("#help-open");
  await looksAsStored(page, "help");
  await page.keyboard.press("Escape");
  await page.click("#benchmark-open");
  await page.waitForSelector("#benchmark-start");
  await looksAsStored(page, "benchmark");
  await page.close();
});
