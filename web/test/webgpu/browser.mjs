/** A headless Chromium with WebGPU on its software adapter, and a server of this repository. Used by the tests here. */
import { createReadStream } from "node:fs";
import { mkdtemp, rm, stat } from "node:fs/promises";
import { createServer } from "node:http";
import { tmpdir } from "node:os";
import { extname, join, normalize } from "node:path";
import { fileURLToPath } from "node:url";
import { chromium } from "playwright-core";

export const repository = fileURLToPath(new URL("../../../", import.meta.url));

const TYPES = {
  ".html": "text/html",
  ".js": "text/javascript",
  ".mjs": "text/javascript",
  ".json": "application/json",
  ".wgsl": "text/plain",
};

const FLAGS = [
  "--headless",
  "--no-sandbox",
  "--disable-quic",
  "--no-first-run",
  "--disable-background-networking",
  "--disable-component-update",
  "--disable-sync",
  "--enable-unsafe-webgpu",
  "--enable-features=Vulkan",
  "--use-vulkan=swiftshader",
  "--use-angle=swiftshader",
];

/** The file behind a path: "/out/…" lies in `out`, the rest in the repository. */
function fileOf(url, out) {
  const path = normalize(decodeURIComponent(new URL(url, "http://localhost").pathname));
  return path.startsWith("/out/") ? join(out, path.slice(5)) : join(repository, path);
}

async function answer(request, response, out) {
  if (request.url === "/favicon.ico") {
    response.writeHead(204).end();
    return;
  }
  if (request.url === "/") {
    response.writeHead(200, { "content-type": "text/html" }).end("<!doctype html><title>test</title>");
    return;
  }
  const file = fileOf(request.url, out);
  const found = await stat(file).catch(() => null);
  if (!found?.isFile()) {
    response.writeHead(404).end();
    return;
  }
  response.writeHead(200, { "content-type": TYPES[extname(file)] ?? "application/octet-stream" });
  createReadStream(file).pipe(response);
}

function serve(out) {
  const server = createServer((request, response) => answer(request, response, out));
  return new Promise((resolve) => server.listen(0, "127.0.0.1", () => resolve(server)));
}

/**
 * Opens a page of this repository's server.
 * @returns {Promise<{page, browser, out: string, url: string, close: () => Promise<void>}>} `out` is an empty folder
 * that the page sees as /out/
 */
export async function openBrowser() {
  const out = await mkdtemp(join(tmpdir(), "dapple-webgpu-"));
  const server = await serve(out);
  const url = `http://localhost:${server.address().port}/`;
  const executablePath = process.env.CHROMIUM ?? "/usr/bin/chromium";
  const browser = await chromium.launch({ executablePath, args: FLAGS, ignoreDefaultArgs: ["--disable-gpu"] });
  const page = await browser.newPage();
  page.on("pageerror", (error) => console.error("page:", error.message));
  page.on("console", (message) => message.type() === "error" && console.error("console:", message.text()));
  await page.goto(url);
  const close = async () => {
    await browser.close();
    server.close();
    await rm(out, { recursive: true });
  };
  return { page, browser, out, url, close };
}
