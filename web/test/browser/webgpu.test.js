// The page on WebGPU, by the browser's software adapter: it lights the drawing, and when the device is lost the
// CPU goes on with the same drawing.
import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { brightness, drag, openSite, pick, pictureBytes, settled } from "./browser.js";

let site;
before(async () => {
  site = await openSite({ gpu: true });
  // So that a test can lose the device as a driver does: the page itself never touches it.
  await site.context.addInitScript(() => {
    const ask = globalThis.GPUAdapter?.prototype.requestDevice;
    if (!ask) return;
    globalThis.devices = [];
    GPUAdapter.prototype.requestDevice = async function (...args) {
      const device = await ask.apply(this, args);
      globalThis.devices.push(device);
      return device;
    };
  });
});
after(() => site.close());

test("WebGPU lights the drawing as the CPU does", async () => {
  const page = await site.page("scene=pillars&size=128");
  await settled(page);
  const cpu = await pictureBytes(page);
  await settled(page, () => page.selectOption("#backend", "webgpu"));
  assert.ok((await page.evaluate(() => devices.length)) >= 1, "a device was opened");
  assert.equal(await page.inputValue("#backend"), "webgpu", await page.textContent("#notice-text"));
  const gpu = await pictureBytes(page);
  const worst = cpu.data.filter((value, i) => Math.abs(value - gpu.data[i]) > 3).length / cpu.data.length;
  assert.ok(worst < 0.01, `${(100 * worst).toFixed(2)} % of the bytes differ by more than 3`);
  await page.close();
});

test("what WebGPU cannot do is done by the CPU, and the panel says so", async () => {
  const page = await site.page("scene=pillars&size=128&backend=webgpu&solver=cascades&skip=exact");
  await settled(page);
  await page.waitForSelector("#used-instead:not([hidden])");
  assert.ok((await page.textContent("#used-instead")).length > 20);
  assert.match(await page.textContent("#used-backend"), /wasm/);
  await page.close();
});

test("a lost device leaves the drawing as it was, and the CPU lights it on", async () => {
  const page = await site.page("scene=empty&size=128&backend=webgpu");
  await pick(page, "tool", "brush");
  await settled(page, () => drag(page, [30, 30], [60, 30]));
  const lit = await brightness(page, [45, 60]);
  await page.evaluate(() => devices.at(-1).destroy());
  await page.waitForSelector("#notice:not([hidden])");
  assert.match(await page.textContent("#notice-text"), /lost.*drawing is as it was/s);
  assert.equal(await page.inputValue("#backend"), "wasm");
  await settled(page);
  assert.ok(Math.abs((await brightness(page, [45, 60])) - lit) < 20, "the stroke is there and lit");
  await settled(page, () => page.keyboard.press("Control+z"));
  assert.ok((await brightness(page, [45, 60])) < lit - 60, "its history too");
  await settled(page, () => page.selectOption("#backend", "webgpu"));
  await page.waitForFunction(() => devices.length >= 2);
  await settled(page);
  assert.equal(await page.inputValue("#backend"), "webgpu", "and WebGPU can be opened again");
  await page.close();
});
