// Which back end lights the picture: opens it, and tells when it is lost. The drawing lives elsewhere, so nothing
// of it is lost with it. Called by main and the frame loop.
import { openWasm, openWebgpu } from "./package.js";
import { whyCpuAlone } from "./ways.js";

const OPEN = { wasm: openWasm, webgpu: openWebgpu };

export class Backends extends EventTarget {
  #open = new Map();

  /** The open back end of a name; opened when it is first asked for. Rejected where there is none. */
  get(name) {
    if (!this.#open.has(name)) {
      const opening = OPEN[name]();
      this.#open.set(name, opening);
      opening.then(
        (backend) => this.#watch(name, opening, backend),
        () => this.#forget(name, opening),
      );
    }
    return this.#open.get(name);
  }

  #watch(name, opening, backend) {
    backend.lost.then((reason) => {
      this.#forget(name, opening);
      this.dispatchEvent(new CustomEvent("lost", { detail: { name, reason } }));
    });
  }

  #forget(name, opening) {
    if (this.#open.get(name) === opening) this.#open.delete(name);
  }

  /** Who solves this: the wanted back end, or WebAssembly where that cannot; then `instead` says why. */
  async choose(name, settings, width, height) {
    const alone = whyCpuAlone(settings.solver);
    if (alone) return { backend: await this.get("wasm"), instead: name === "wasm" ? null : alone };
    const wanted = await this.get(name);
    const refusal = wanted.refuses(settings, width, height);
    if (!refusal) return { backend: wanted, instead: null };
    const backend = await this.get("wasm");
    const last = backend === wanted ? refusal : backend.refuses(settings, width, height);
    if (last) throw new Error(last);
    return { backend, instead: refusal };
  }
}

/** One sentence that says why there is no WebGPU here, or null where there may be. */
export async function whyNoWebgpu() {
  if (!globalThis.isSecureContext) return "WebGPU needs a page served from localhost or over https.";
  if (!navigator.gpu) return "This browser has no WebGPU.";
  try {
    return (await navigator.gpu.requestAdapter())
      ? null
      : "This browser has WebGPU, but no graphics adapter for it here.";
  } catch (error) {
    return `WebGPU did not start: ${error.message}`;
  }
}
