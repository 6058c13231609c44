// The one place that names the package's files: everything else of the page imports from here.
export { openWasm, studyTable } from "../dapple/index.js";

/** WebGPU is loaded by those who ask for it: the first picture does not wait for it. */
export async function openWebgpu() {
  const webgpu = await import("../dapple/webgpu/index.js");
  return webgpu.openWebgpu();
}
