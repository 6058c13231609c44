// Workers of browsers and of node behind one shape. Used by worker.js and helper.js (workerPort) and by the
// crew (spawn).

export const isNode = typeof process === "object" && Boolean(process.versions?.node);

/** Inside a worker: { post(message, transfer), listen(handler) }. */
export async function workerPort() {
  if (isNode) {
    const { parentPort } = await import("node:worker_threads");
    return {
      post: (message, transfer) => parentPort.postMessage(message, transfer),
      listen: (handler) => parentPort.on("message", handler),
    };
  }
  return {
    post: (message, transfer) => globalThis.postMessage(message, transfer ?? []),
    listen: (handler) => globalThis.addEventListener("message", (event) => handler(event.data)),
  };
}

/** Outside: starts a module worker. `failed` is called with a sentence when it dies on its own. */
export async function spawn(url, handler, failed) {
  if (isNode) {
    const { Worker } = await import("node:worker_threads");
    const worker = new Worker(url);
    let ended = false, why = "the worker ended";
    worker.on("message", handler);
    // An error may overtake the worker's last messages; its exit never does.
    worker.on("error", (error) => (why = `the worker died: ${error.message}`));
    worker.on("exit", () => ended || failed(why));
    return {
      post: (message, transfer) => worker.postMessage(message, transfer),
      end: () => ((ended = true), worker.terminate()),
      // An idle back end does not keep a program alive.
      hold: (busy) => (busy ? worker.ref() : worker.unref()),
    };
  }
  const worker = new Worker(url, { type: "module" });
  worker.addEventListener("message", (event) => handler(event.data));
  worker.addEventListener("error", (event) => failed(`the worker died: ${event.message ?? "it could not load"}`));
  return {
    post: (message, transfer) => worker.postMessage(message, transfer ?? []),
    end: () => worker.terminate(),
    hold: () => {},
  };
}
