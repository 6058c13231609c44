// A thread of the crew (web/wasm/crew.h): sleeps until there is work, and takes its share. Started by crew.js.
import { Core } from "./core.js";
import { workerPort } from "./port.js";

const port = await workerPort();
port.listen(async ({ module, memory, address, stack, worker }) => {
  const host = { progress: () => true, number: () => {} };
  const core = await Core.start(module, memory, host, false);
  core.call.__stack_pointer.value = stack;
  const generation = new Int32Array(memory.buffer, address, 1); // the crew's first member
  port.post({ started: true });
  for (let seen = 0; ; ) {
    Atomics.wait(generation, 0, seen);
    const now = Atomics.load(generation, 0);
    if (now === seen) continue;
    seen = now;
    core.call.dpl_web_crew_help(address, worker);
  }
});
port.post({ ready: true });
