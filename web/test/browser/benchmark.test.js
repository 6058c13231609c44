// The benchmark on the page: the same rows as `dapple study` writes, a table, correlations, CSV files.
//
// Stated bounds: counted rays, chosen modes and the paper's world must be equal; figures in dB and rel_rmse may
// differ by half a unit of the last digit that is written, which is one unit here.
import assert from "node:assert/strict";
import { execFile } from "node:child_process";
import { mkdtemp, readFile, rm } from "node:fs/promises";
import { tmpdir } from "node:os";
import path from "node:path";
import { after, before, test } from "node:test";
import { promisify } from "node:util";
import { DAPPLE, fill, openSite } from "./browser.js";

const run = promisify(execFile);
let site;
before(async () => (site = await openSite()));
after(() => site.close());

const rowsOf = (csv) =>
  csv
    .trim()
    .split("\n")
    .map((line) => line.split(","));

/** Equal texts, or numbers with decimals that differ by one in the last place. */
function agree(here, there) {
  if (here === there) return true;
  const decimals = there.split(".")[1]?.length;
  return Boolean(decimals) && Math.abs(Number(here) - Number(there)) <= 1.01 * 10 ** -decimals;
}

test("five scenes of one seed are the rows of dapple study", async () => {
  const folder = await mkdtemp(path.join(tmpdir(), "dapple-study-"));
  const page = await site.page("scene=empty");
  await page.click("#benchmark-open");
  await fill(page, "benchmark-seed", 3);
  await fill(page, "benchmark-scenes", 5);
  await page.selectOption("#benchmark-size", "128");
  await fill(page, "benchmark-truth", 32);
  await page.click("#benchmark-start");
  await page.waitForFunction(() => document.querySelector("#benchmark-status").textContent.startsWith("Done"), null, {
    timeout: 40000,
  });
  const [download] = await Promise.all([page.waitForEvent("download"), page.click("#benchmark-csv")]);
  assert.equal(download.suggestedFilename(), "results.csv");
  const here = rowsOf(await readFile(await download.path(), "utf8"));

  const options = [
    "--seeds",
    "1",
    "--first-seed",
    "3",
    "--scenes",
    "5",
    "--size",
    "128",
    "--truth",
    "32",
    "--out",
    folder,
  ];
  await run(DAPPLE, ["study", ...options]);
  const there = rowsOf(await readFile(path.join(folder, "results.csv"), "utf8"));
  await rm(folder, { recursive: true });
  assert.equal(here.length, 1 + 5 * 2 * 6);
  assert.equal(here.length, there.length);
  there.forEach((row, i) =>
    row.forEach((cell, k) =>
      assert.ok(agree(here[i][k], cell), `row ${i}, ${there[0][k]}: ${here[i][k]} is not ${cell}`),
    ),
  );

  assert.equal(await page.locator("#benchmark-table tbody tr").count(), 5);
  const correlations = await page.locator("#benchmark-correlations tr").allTextContents();
  assert.equal(correlations.length, 7);
  assert.match(correlations[0], /light count-?\d\.\d\d-?\d\.\d\d … -?\d\.\d\d0\.81/);
  assert.equal(await page.locator("#benchmark-chart circle.point").count(), 5);
  const [second] = await Promise.all([page.waitForEvent("download"), page.click("#benchmark-correlations-csv")]);
  assert.equal(rowsOf(await readFile(await second.path(), "utf8")).length, 1 + 2 * 2 * 7);
  await page.close();
});

test("stopping the benchmark keeps what is done, and drawing goes on meanwhile", async () => {
  const page = await site.page("scene=empty");
  await page.click("#benchmark-open");
  await page.selectOption("#benchmark-size", "128");
  await page.click("#benchmark-start");
  await page.waitForFunction(() => document.querySelectorAll("#benchmark-table tbody tr").length >= 2);
  await page.click("#benchmark-stop");
  await page.waitForFunction(() =>
    /^Stopped after \d+ of 50/.test(document.querySelector("#benchmark-status").textContent),
  );
  assert.ok((await page.locator("#benchmark-table tbody tr").count()) >= 2);
  assert.ok((await page.locator("#benchmark-progress").evaluate((bar) => bar.value)) > 0);
  await page.close();
});
