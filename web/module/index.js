// The dapple package: light for pixel worlds. Types and documentation: index.d.ts.
export { openWasm } from "./wasm.js";
export { DappleError } from "./core.js";
export { studyTable } from "./study.js";
export { tonemap } from "./tonemap.js";
