// The one place that names the package's files: everything else of the page imports from here.
export { openWasm, studyTable } from "../dapple/index.js";
export { openWebgpu } from "../dapple/webgpu/index.js";
