import type { Backend } from "dapple";

export interface WebgpuOptions {
  /** What stands in for navigator.gpu. */
  gpu?: { requestAdapter(options?: object): Promise<unknown> };
  /** Folder that holds the WGSL files, relative to the document, ending in "/"; default: the package's own. */
  shaders?: string | URL;
  /** Default: the browser's choice. */
  powerPreference?: "low-power" | "high-performance";
}

/** Opens the WebGPU back end; rejected with one sentence where there is no WebGPU. May be called again after a loss. */
export function openWebgpu(options?: WebgpuOptions): Promise<Backend>;
