// Builds web/dist: the package (dist/dapple) and the static site around it. Run by `npm run build`.
//
// The three builds of the module are made by CMake presets; everything else is copied as it is.
import { spawnSync } from "node:child_process";
import { cp, mkdir, readdir, rm } from "node:fs/promises";
import { existsSync } from "node:fs";
import { availableParallelism } from "node:os";
import { fileURLToPath } from "node:url";

const root = new URL("../", import.meta.url), web = new URL("web/", root), dist = new URL("dist/", web);
const presets = { "wasm-scalar": "scalar", wasm: "simd128", "wasm-threads": "threads" };

/** Runs a command in the repository; prints what it said only when it fails. */
function run(command, ...options) {
  const done = spawnSync(command, options, { cwd: fileURLToPath(root), encoding: "utf8" });
  if (done.status === 0) return;
  console.error(`${command} ${options.join(" ")}\n${done.stdout ?? ""}${done.stderr ?? done.error?.message ?? ""}`);
  process.exit(1);
}

/** Copies a folder's content, if it exists. */
async function copyInto(from, to) {
  if (existsSync(from)) await cp(from, to, { recursive: true });
}

for (const preset of Object.keys(presets)) {
  run("cmake", "--preset", preset);
  run("cmake", "--build", "--preset", preset, "-j", String(availableParallelism()));
}

const made = new URL("dapple/", dist);
await rm(dist, { recursive: true, force: true });
await mkdir(made, { recursive: true });
await copyInto(new URL("module/", web), made);
await cp(new URL("LICENSE", root), new URL("LICENSE", made));
for (const [preset, build] of Object.entries(presets)) {
  const name = `dapple-${build}.wasm`;
  await cp(new URL(`build/${preset}/web/wasm/${name}`, root), new URL(name, made));
}
// The second back end looks for its shaders beside its own folder.
await copyInto(new URL("webgpu/", web), new URL("webgpu/", made));
await copyInto(new URL("shaders/", root), new URL("shaders/", made));
await copyInto(new URL("page/", web), dist);

console.log(`web/dist: ${(await readdir(dist)).join(", ")}`);
