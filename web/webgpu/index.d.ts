import type { Backend } from "../module/backend.js";

export interface WebgpuOptions {
  /** Default: navigator.gpu. */
  gpu?: GPU;
  /** Folder that holds the WGSL files; default: the one that lies beside the package. */
  shaders?: string | URL;
  powerPreference?: GPUPowerPreference;
}

/** Opens the WebGPU back end; rejected with one sentence where there is no WebGPU. May be called again after a loss. */
export function openWebgpu(options?: WebgpuOptions): Promise<Backend>;
