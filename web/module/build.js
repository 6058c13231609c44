// Which of the three builds of the module this machine can run, and its code. Used by wasm.js.
import { isNode } from "./port.js";

// () -> v128: i32.const 0, i8x16.splat
const SIMD_PROBE = new Uint8Array([0, 97, 115, 109, 1, 0, 0, 0, 1, 5, 1, 96, 0, 1, 123, 3, 2, 1, 0,
  10, 8, 1, 6, 0, 65, 0, 253, 15, 11]);

// Pages of 64 KiB; as web/wasm/CMakeLists.txt has them.
const SHARED_PAGES = 64, SHARED_PAGES_MAX = 32768;

export const BUILDS = ["scalar", "simd128", "threads"];

export function hasSimd() {
  return WebAssembly.validate(SIMD_PROBE);
}

/** Can workers share memory here? */
export function hasSharedMemory() {
  return typeof SharedArrayBuffer === "function" && (isNode || globalThis.crossOriginIsolated === true);
}

export async function processors() {
  if (!isNode) return navigator.hardwareConcurrency ?? 1;
  return (await import("node:os")).availableParallelism();
}

/** Memory for threads, or null when this machine does not give it. */
export function sharedMemory() {
  try {
    return new WebAssembly.Memory({ initial: SHARED_PAGES, maximum: SHARED_PAGES_MAX, shared: true });
  } catch (error) {
    if (error instanceof RangeError) return null;
    throw error;
  }
}

/** Compiles a build, which lies beside this file. */
export async function loadModule(build) {
  const url = new URL(`./dapple-${build}.wasm`, import.meta.url);
  if (isNode) {
    const { readFile } = await import("node:fs/promises");
    return WebAssembly.compile(await readFile(url));
  }
  const response = await fetch(url);
  if (!response.ok) throw new Error(`${url.pathname}: the server answered ${response.status}`);
  // A server that does not know the type still serves the bytes.
  if (response.headers.get("content-type")?.startsWith("application/wasm"))
    return WebAssembly.compileStreaming(response);
  return WebAssembly.compile(await response.arrayBuffer());
}
