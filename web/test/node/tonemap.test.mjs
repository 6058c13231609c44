// The tone map in JavaScript is the library's.
import assert from "node:assert/strict";
import { readFile } from "node:fs/promises";
import path from "node:path";
import { test } from "node:test";
import { inflateSync } from "node:zlib";
import { tonemap } from "../../dist/dapple/index.js";
import { dapple, inFolder, readPfm } from "./native.mjs";

/** What PNG's filters predict a byte from: the ones left, above, and above left. */
const PREDICT = [
  () => 0,
  (left) => left,
  (left, above) => above,
  (left, above) => (left + above) >> 1,
  (left, above, corner) => {
    const p = left + above - corner, a = Math.abs(p - left), b = Math.abs(p - above), c = Math.abs(p - corner);
    return a <= b && a <= c ? left : b <= c ? above : corner;
  },
];

/** Bytes of an 8-bit RGB PNG. */
function decodePng(file, width, height) {
  const parts = [];
  for (let at = 8; at < file.length; at += 12 + file.readUInt32BE(at))
    if (file.toString("latin1", at + 4, at + 8) === "IDAT")
      parts.push(file.subarray(at + 8, at + 8 + file.readUInt32BE(at)));
  const raw = inflateSync(Buffer.concat(parts)), row = 3 * width, out = new Uint8Array(row * height);
  for (let y = 0; y < height; y++)
    for (let i = 0; i < row; i++) {
      const at = y * row + i, left = i < 3 ? 0 : out[at - 3], above = y ? out[at - row] : 0;
      const corner = y && i >= 3 ? out[at - row - 3] : 0;
      out[at] = raw[y * (row + 1) + 1 + i] + PREDICT[raw[y * (row + 1)]](left, above, corner);
    }
  return out;
}

test("light is shown as the bytes that the command writes", () => inFolder(async (folder) => {
  await dapple("scenes", "demo", "--seed", 1, "--size", 128, "--out", folder);
  const scene = path.join(folder, "demo-00.json"), [pfm, png] = ["pfm", "png"].map((x) => path.join(folder, x));
  await dapple("render", scene, "-o", `${pfm}.pfm`);
  await dapple("render", scene, "-o", `${png}.png`);
  const { values, width, height } = await readPfm(`${pfm}.pfm`);
  const wanted = decodePng(await readFile(`${png}.png`), width, height), found = tonemap(values);
  assert.equal(found.length, 4 * width * height);
  let differing = 0;
  for (let i = 0; i < width * height; i++)
    for (let c = 0; c < 4; c++) differing += found[4 * i + c] !== (c < 3 ? wanted[3 * i + c] : 255);
  assert.equal(differing, 0);
}));

test("what is no light is black, and exposure scales", () => {
  assert.deepEqual([...tonemap(new Float32Array([NaN, -1, 1e30]))], [0, 0, 255, 255]);
  assert.deepEqual(tonemap(new Float32Array([0.1, 0.2, 0.4]), 2), tonemap(new Float32Array([0.2, 0.4, 0.8])));
});
