// What is shipped: small modules, types that hold, and a server with the right headers.
import assert from "node:assert/strict";
import { mkdir, readFile, readdir, writeFile } from "node:fs/promises";
import http from "node:http";
import path from "node:path";
import { test } from "node:test";
import { gzipSync } from "node:zlib";
import { serve } from "../../serve.mjs";
import { inFolder } from "./native.mjs";

const made = new URL("../../dist/dapple/", import.meta.url);
const MOST = 150_000; // bytes, compressed

test("each WebAssembly module is below 150 kB compressed", async (t) => {
  const names = (await readdir(made)).filter((name) => name.endsWith(".wasm"));
  assert.deepEqual(names.sort(), ["dapple-scalar.wasm", "dapple-simd128.wasm", "dapple-threads.wasm"]);
  for (const name of names) {
    const size = gzipSync(await readFile(new URL(name, made)), { level: 9 }).length;
    t.diagnostic(`${name}: ${size} bytes`);
    assert.ok(size < MOST, `${name} has ${size} bytes`);
  }
});

test("the package names only files that exist", async () => {
  const { exports } = JSON.parse(await readFile(new URL("../../package.json", import.meta.url), "utf8"));
  for (const file of Object.values(exports["."]))
    await readFile(new URL(`../../${file}`, import.meta.url));
});

/** Answers of the server as they are: fetch would tidy the path up. */
function ask(url, asked, method = "GET") {
  return new Promise((resolve, reject) => {
    const { hostname, port } = new URL(url);
    http.request({ hostname, port, path: asked, method }, (response) => {
      let text = "";
      response.on("data", (part) => (text += part));
      response.on("end", () => resolve({ status: response.statusCode, headers: response.headers, text }));
    }).on("error", reject).end();
  });
}

test("the server isolates pages, knows its types and stays in its folder", () => inFolder(async (folder) => {
  const site = path.join(folder, "site");
  await mkdir(site);
  await writeFile(path.join(site, "index.html"), "<p>hello");
  await writeFile(path.join(site, "a.wasm"), "x");
  await writeFile(path.join(folder, "secret"), "secret");
  const { url, close } = await serve(site);
  try {
    assert.match(url, /^http:\/\/127\.0\.0\.1:\d+\/$/);
    const page = await ask(url, "/");
    assert.equal(page.text, "<p>hello");
    assert.equal(page.headers["cross-origin-opener-policy"], "same-origin");
    assert.equal(page.headers["cross-origin-embedder-policy"], "require-corp");
    assert.match(page.headers["content-type"], /^text\/html/);
    assert.equal((await ask(url, "/a.wasm")).headers["content-type"], "application/wasm");
    for (const outside of ["/../secret", "/%2e%2e/secret", "/..%2fsecret", "/%00", "/nothing", "/%"]) {
      const answer = await ask(url, outside);
      assert.equal(answer.status, 404, outside);
      assert.doesNotMatch(answer.text, /secret/);
    }
    assert.equal((await ask(url, "/", "POST")).status, 405);
    assert.equal((await ask(url, "/a.wasm", "HEAD")).headers["content-length"], "1");
  } finally {
    await close();
  }
}));
