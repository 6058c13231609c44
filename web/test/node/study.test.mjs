// The study in the module is `dapple study`.
import assert from "node:assert/strict";
import { readFile } from "node:fs/promises";
import path from "node:path";
import { test } from "node:test";
import { openWasm, studyTable } from "../../dist/dapple/index.js";
import { dapple, inFolder } from "./native.mjs";

const PLAN = { seed: 3, scenes: 5, size: 64, truth: 64 };

function rowsOf(text) {
  const [head, ...rows] = text.trim().split("\n").map((line) => line.split(","));
  return rows.map((row) => Object.fromEntries(head.map((name, i) => [name, row[i]])));
}

test("a study writes the same table and correlations as the command, byte for byte", () =>
  inFolder(async (folder) => {
    await dapple("study", "--seeds", 1, "--first-seed", PLAN.seed, "--scenes", PLAN.scenes, "--size", PLAN.size,
      "--truth", PLAN.truth, "--out", folder);
    for (const options of [{ build: "simd128" }, { build: "threads", threads: 2 }]) {
      const backend = await openWasm(options);
      try {
        const told = [], progress = [];
        const { records, correlations } = await backend.study(PLAN, {
          scene: (record, index) => told.push([record.index, index]),
          progress: (done) => progress.push(done),
        });
        assert.equal(studyTable(records), await readFile(path.join(folder, "results.csv"), "utf8"));
        assert.deepEqual(told, records.map((_, i) => [i, i]));
        assert.ok(progress.every((done, i) => done >= (progress[i - 1] ?? 0) && done <= 1));
        const wanted = rowsOf(await readFile(path.join(folder, "correlations.csv"), "utf8"));
        const seeds = wanted.filter((row) => row.seed === String(PLAN.seed));
        assert.equal(correlations.length, seeds.length);
        for (const row of seeds) {
          const found = correlations.find((c) => c.profile === row.profile && c.signal === row.signal &&
            `${c.quality}_vs_off` === row.with_L2_mode);
          for (const [ours, theirs] of [["r", "r"], ["low", "low95"], ["high", "high95"]])
            assert.equal(found[ours].toFixed(6), row[theirs], `${row.profile} ${row.signal} ${ours}`);
        }
      } finally {
        backend.close();
      }
    }
  }));

test("a study can be aborted, and another begun", async () => {
  const backend = await openWasm();
  try {
    const control = new AbortController();
    const study = backend.study({ ...PLAN, scenes: 50 }, { signal: control.signal, scene: () => control.abort() });
    await assert.rejects(study, { name: "AbortError" });
    const { records } = await backend.study({ ...PLAN, scenes: 1 });
    assert.equal(records.length, 1);
  } finally {
    backend.close();
  }
});
