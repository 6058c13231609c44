/** A headless Chromium with WebGPU on its software adapter, and a page that sees this repository. Used by the tests here. */
import { mkdir, mkdtemp, rm, symlink, writeFile } from "node:fs/promises";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { fileURLToPath } from "node:url";
import { openChromium } from "../chromium.mjs";

export const repository = fileURLToPath(new URL("../../../", import.meta.url));

/** A folder with an empty page, what pages import, and an empty folder: out. */
async function makeSite() {
  const site = await mkdtemp(join(tmpdir(), "dapple-webgpu-"));
  await mkdir(join(site, "out"));
  await writeFile(join(site, "index.html"), '<!doctype html><title>test</title><link rel="icon" href="data:,">');
  for (const folder of ["web", "shaders"]) await symlink(join(repository, folder), join(site, folder));
  return site;
}

/**
 * Opens a page of this repository's server.
 * @returns {Promise<{page, browser, out: string, url: string, close: () => Promise<void>}>} `out` is an empty folder
 * that the page sees as /out/
 */
export async function openBrowser() {
  const site = await makeSite();
  const { url, browser, context, end } = await openChromium(site, { gpu: true });
  const page = await context.newPage();
  page.on("pageerror", (error) => console.error("page:", error.message));
  page.on("console", (message) => message.type() === "error" && console.error("console:", message.text()));
  await page.goto(url);
  const close = async () => {
    await end();
    await rm(site, { recursive: true });
  };
  return { page, browser, out: join(site, "out"), url, close };
}
