// How the page looks: screenshots of its states against stored ones, both shrunk, so that another font or a
// driver does not matter but a broken layout or a missing picture does. UPDATE=1 stores what is seen.
import assert from "node:assert/strict";
import { existsSync } from "node:fs";
import { mkdir, readFile, writeFile } from "node:fs/promises";
import path from "node:path";
import { after, before, test } from "node:test";
import { ROOT, decoded, openSite, pick, settled } from "./browser.js";

const FOLDER = path.join(ROOT, "web/test/browser/pictures");
/** Mean difference of bytes that is allowed, and the share of bytes that may differ by more than FAR. */
const MEAN = 6,
  SHARE = 0.05,
  FAR = 40;
const SHRINK = 4;

let site;
before(async () => (site = await openSite()));
after(() => site.close());

async function looksAsStored(page, name) {
  // Times change from run to run.
  const seen = await decoded(
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
  const stored = await decoded(page, await readFile(file), 1);
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
  ["tiles", "solver=flood", "light"],
  ["pillars-lit", "scene=pillars", "lit"],
  ["stained-walls", "scene=stained", "walls"],
])
  test(`the scene ${name} looks as stored`, async () => {
    const page = await site.page(hash);
    await pick(page, "view", view);
    await settled(page);
    await page.waitForSelector("#webgpu-note:not([hidden])");
    await page.waitForSelector("#stages[aria-busy=false]");
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
