import type { Backend } from "dapple";

export interface WebgpuOptions {
  /** Default: navigator.gpu. */
  gpu?: GPU;
  /** Folder that holds the WGSL files, relative to the document, ending in "/"; default: the package's own. */
  shaders?: string | URL;
  powerPreference?: GPUPowerPreference;
}

/** Opens the WebGPU back end; rejected with one sentence where there is no WebGPU. May be called again after a loss. */
export function openWebgpu(options?: WebgpuOptions): Promise<Backend>;
