// What lights a world: a back end's solvers, and what the CPU alone has besides, behind one question and answer.
// Called by the loop, the truth and backends.js.
import { floodLight } from "./flood.js";
import { shadowLight } from "./shadows.js";

/** Methods of the CPU's back end that are no solvers. */
const BESIDES = {
  shadows: { light: shadowLight, only: "Soft shadows are computed by the CPU." },
  flood: { light: floodLight, only: "Flood fill is computed by the CPU." },
};

/** Why a method is the CPU's alone, or null. */
export function whyCpuAlone(solver) {
  return BESIDES[solver]?.only ?? null;
}

/** Lights a world as `asked` says; `lights` are discs, for those that know such. Reads the planes before it returns. */
export function solveAny(backend, world, asked, lights, options) {
  const besides = BESIDES[asked.solver];
  if (besides) return besides.light(backend, world, asked, lights, options);
  const { albedo, ...planes } = world.planes();
  return backend.solve(asked.bounces > 0 ? { ...planes, albedo } : planes, asked, options); // no copy of what is not read
}
