// Soft shadows of disc lights as one more way to light a world: the same question and answer as a back end's
// solve(). Called by ways.js.

/** The lantern as a disc light; it blocks nothing. */
export function lightOfLantern(at, material, radius) {
  return { position: at, radius, color: material.emission, intensity: 1 };
}

/** Reads the planes before it returns. */
export async function shadowLight(backend, world, asked, lights, options) {
  const { width, height } = world,
    begin = performance.now();
  const light = await backend.shadows(world.planes(), lights, { ...options, method: asked.method });
  const stages = [{ name: "shadows", ms: performance.now() - begin }];
  return { width, height, light, stats: { levels: [], raysFull: 0, raysTraced: 0, skip: null, stages } };
}
