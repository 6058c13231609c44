// A program against the package's types: what it says must compile, and what it forbids must not.
import { DappleError, openWasm, studyTable, tonemap, type Backend, type World } from "dapple";

const world: World = {
  width: 2,
  height: 1,
  emission: new Float32Array(6),
  extinction: new Float32Array([Infinity, Infinity, Infinity, 0, 0, 0]),
  sky: [0, 0, 0.1],
};

export async function light(backend: Backend, signal: AbortSignal): Promise<Uint8ClampedArray> {
  const refused: string | null = backend.refuses({ solver: "cascades", skip: "auto" }, 2, 1);
  if (refused) throw new DappleError();
  const { light, stats } = await backend.solve(world, { solver: "cascades", skip: "bounded", boundDb: 40 },
    { signal, progress: (done: number) => void done });
  const names: string[] = stats.stages.map((stage) => stage.name);
  void names;
  // @ts-expect-error there is no such solver
  await backend.solve(world, { solver: "magic" });
  // @ts-expect-error planes are floats
  await backend.solve({ ...world, emission: [0] });
  return tonemap(light, 1.5);
}

export async function everything(): Promise<string> {
  const backend = await openWasm({ build: "auto", threads: 2 });
  const scene = await backend.makeScene("arc", 1n, 0, 64);
  const shadows: Float32Array = await backend.shadows(scene, scene.lights, { method: "rays" });
  const { psnrDisplay } = await backend.compare(shadows, shadows, 64, 64);
  const distance: Float32Array = await backend.distance(scene);
  const { light, stats } = await backend.flood({ width: 1, height: 1, walls: new Uint8Array(1), lights: new Float32Array(3) },
    { falloff: "round", range: 8 });
  const visits: number = stats.visits + light.length;
  const { records, correlations } = await backend.study({ scenes: 1, size: 64, truth: 16 });
  const sentence: string = await backend.lost;
  backend.close();
  return [psnrDisplay, distance.length, visits, correlations[0]?.r, sentence, studyTable(records)].join("\n");
}
