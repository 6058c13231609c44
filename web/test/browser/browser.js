// What the browser tests share: the site on a port of its own, one Chromium for all files that suite.mjs loads, pages that note every error, and
// ways to draw and to read pixels. Used by every *.test.js of this folder.
import assert from "node:assert/strict";
import path from "node:path";
import { fileURLToPath } from "node:url";
import { openChromium } from "../chromium.mjs";

/** Nothing that a page does takes longer, even on a busy machine [ms]. */
const PATIENCE = 20000;

export const ROOT = fileURLToPath(new URL("../../../", import.meta.url));

/** The native command, which the page's figures are held against. */
export const DAPPLE = path.join(ROOT, "build/release/tools/dapple/dapple");

/** Sites that are open by kind of browser: { users, opening }. */
const sites = new Map();

/** A browser with the site: { page(address, options), close() }. `gpu`: with WebGPU. All who ask for the same kind share
 * one, which ends when the last has closed it. */
export async function openSite({ gpu = false } = {}) {
  if (!sites.has(gpu)) sites.set(gpu, { users: 0, opening: startSite(gpu) });
  const shared = sites.get(gpu);
  shared.users++;
  const { end, ...site } = await shared.opening;
  const close = async () => {
    if (--shared.users > 0) return;
    sites.delete(gpu);
    await end();
  };
  return { ...site, close };
}

async function startSite(gpu) {
  const { url, context, end } = await openChromium(path.join(ROOT, "web/dist"), {
    gpu,
    viewport: { width: 1280, height: 860 },
    acceptDownloads: true,
    timeout: PATIENCE,
  });
  context.setDefaultTimeout(PATIENCE);
  return {
    url,
    context,
    end,
    page: (hash = "", viewport, address = url) => openPage(context, address, hash, viewport),
  };
}

/** A page that is ready to draw on and shows its light. Closing it fails when anything went wrong on it meanwhile. */
export async function openPage(context, url, hash, viewport) {
  const page = await context.newPage();
  const errors = [];
  page.on("console", (message) => message.type() === "error" && errors.push(message.text()));
  page.on("pageerror", (error) => errors.push(error.message));
  page.on("requestfailed", (request) => errors.push(`${request.url()}: ${request.failure().errorText}`));
  if (viewport) await page.setViewportSize(viewport);
  await page.goto(`${url}${hash ? `#${hash}` : ""}`);
  await page.waitForSelector("html[data-state=ready]", { state: "attached" });
  const close = page.close.bind(page);
  page.close = async () => {
    await close();
    assert.deepEqual(errors, [], "the console shows no error");
  };
  return page;
}

/** Picks a radio of the form as a person does: by clicking what is written on it. */
export async function pick(page, name, value) {
  await page.locator(`input[name="${name}"][value="${value}"]`).check();
}

/** Moves a slider or fills a field. */
export async function fill(page, id, value) {
  await page.locator(`#${id}`).fill(String(value));
}

/** Where a place of the picture is on the screen; places are those of 256 pixels. */
async function onScreen(page, [x, y]) {
  const box = await page.locator("#picture").boundingBox();
  return [box.x + (box.width * x) / 256, box.y + (box.height * y) / 256];
}

export async function hover(page, place) {
  await page.mouse.move(...(await onScreen(page, place)));
}

export async function click(page, place) {
  await hover(page, place);
  await page.mouse.down();
  await page.mouse.up();
}

export async function drag(page, from, to) {
  await hover(page, from);
  await page.mouse.down();
  await page.mouse.move(...(await onScreen(page, to)), { steps: 6 });
  await page.mouse.up();
}

/** Bytes of the pixel at a place of the picture. */
export function pixel(page, place) {
  return page.evaluate((place) => {
    const canvas = document.querySelector("#picture");
    const [x, y] = place.map((value) => Math.floor((value * canvas.width) / 256));
    return [...canvas.getContext("2d").getImageData(x, y, 1, 1).data].slice(0, 3);
  }, place);
}

export async function brightness(page, place) {
  const [r, g, b] = await pixel(page, place);
  return r + g + b;
}

/** Does something, and waits until the light of it is there: nothing is left to solve or to paint. */
export async function settled(page, action = async () => {}) {
  await action();
  await page.waitForSelector("#picture[aria-busy=false]", { timeout: PATIENCE });
}

/** The whole picture as { width, height, data }: RGBA bytes. */
export async function pictureBytes(page) {
  const { width, height, text } = await page.evaluate(() => {
    const canvas = document.querySelector("#picture");
    const { data } = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height);
    let text = "";
    for (let i = 0; i < data.length; i += 8192) text += String.fromCharCode(...data.subarray(i, i + 8192));
    return { width: canvas.width, height: canvas.height, text: btoa(text) };
  });
  return { width, height, data: Buffer.from(text, "base64") };
}

/** A PNG as { width, height, data, png }: RGBA bytes after shrinking, decoded by the browser itself. */
export async function decoded(page, png, factor = 1) {
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
