// Headless Chromium as all tests start it: one list of flags, one server. Used by browser/browser.js and
// webgpu/browser.mjs.
import { chromium } from "playwright-core";
import { serve } from "../serve.mjs";

const FLAGS = [
  "--no-sandbox",
  "--disable-quic",
  "--no-first-run",
  "--disable-background-networking",
  "--disable-component-update",
  "--disable-sync",
];
/** WebGPU on the software adapter. */
const GPU_FLAGS = [
  "--enable-unsafe-webgpu",
  "--enable-features=Vulkan",
  "--use-vulkan=swiftshader",
  "--use-angle=swiftshader",
];

/** Serves a folder and starts a browser with an empty profile: { url, browser, context, end() }. `gpu`: with WebGPU;
 * `timeout` for starting [ms]; the rest are the context's options. */
export async function openChromium(folder, { gpu = false, timeout, ...options } = {}) {
  const site = await serve(folder);
  const browser = await chromium.launch({
    executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium",
    args: gpu ? [...FLAGS, ...GPU_FLAGS] : FLAGS,
    ignoreDefaultArgs: gpu ? ["--disable-gpu"] : [],
    timeout,
  });
  const end = async () => {
    await browser.close();
    await site.close();
  };
  return { url: site.url, browser, context: await browser.newContext(options), end };
}
