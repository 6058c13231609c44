// The command as the tests compare with it: renders scenes natively and reads what it wrote.
import { execFile } from "node:child_process";
import { existsSync } from "node:fs";
import { mkdtemp, readFile, rm } from "node:fs/promises";
import { tmpdir } from "node:os";
import path from "node:path";
import { fileURLToPath } from "node:url";
import { promisify } from "node:util";

const command = fileURLToPath(new URL("../../../build/release/tools/dapple/dapple", import.meta.url));

/** Runs `dapple ARGUMENTS`; its standard output. */
export async function dapple(...given) {
  if (!existsSync(command)) throw new Error("build/release has no dapple: build that preset first");
  const { stdout } = await promisify(execFile)(command, given.map(String), { maxBuffer: 2 ** 26 });
  return stdout;
}

/** Calls `use(folder)` with a folder that is gone afterwards. */
export async function inFolder(use) {
  const folder = await mkdtemp(path.join(tmpdir(), "dapple-test-"));
  try {
    return await use(folder);
  } finally {
    await rm(folder, { recursive: true, force: true });
  }
}

/** Values of a PFM, row by row from the top. */
export async function readPfm(file) {
  const bytes = await readFile(file);
  const head = /^PF\n(\d+) (\d+)\n(-[\d.]+)\n/.exec(bytes.toString("latin1", 0, 64));
  if (!head) throw new Error(`${file} is no colour PFM of little-endian floats`);
  const width = Number(head[1]), height = Number(head[2]), row = 3 * width;
  const below = new Float32Array(bytes.buffer.slice(bytes.byteOffset + head[0].length));
  const values = new Float32Array(row * height);
  for (let y = 0; y < height; y++)
    values.set(below.subarray((height - 1 - y) * row, (height - y) * row), y * row);
  return { width, height, values };
}
