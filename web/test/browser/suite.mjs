// All browser tests in one process, so that they share a browser: what `make test` runs. A file can be run alone, too.
import { readdir } from "node:fs/promises";

for (const name of (await readdir(new URL(".", import.meta.url))).sort())
  if (name.endsWith(".test.js")) await import(`./${name}`);
