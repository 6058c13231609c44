/**
 * A plan is what a solver does at one size: buffers that stay, and dispatches over them in order. Made once by
 * cascades.js and holographic.js, then run frame after frame.
 */
import { guarded } from "./kit.js";

/** Invocations of a group, as shaders/item.wgsl says. */
export const GROUP = 128;

/** Most groups in one dimension of a dispatch; every WebGPU device allows it. */
const MOST_GROUPS = 65535;

/** Most passes that are timed in one run. */
const MOST_PASSES = 64;
const QUERY_BYTES = MOST_PASSES * 2 * 8;

/** Groups for a flat list of items, as item_of() in shaders/item.wgsl counts them. */
export function groupsFor(items) {
  const groups = Math.ceil(items / GROUP);
  const rows = Math.ceil(groups / MOST_GROUPS);
  return [Math.ceil(groups / rows), rows, 1];
}

/** Fields of a uniform, packed as WGSL does where every field is as wide as its alignment. */
export const u32 = (...values) => new Uint32Array(values);
export const f32 = (...values) => new Float32Array(values);

function packed(fields) {
  const bytes = fields.flatMap((field) => [...new Uint8Array(field.buffer)]);
  const padding = (16 - (bytes.length % 16)) % 16;
  return new Uint8Array([...bytes, ...new Array(padding).fill(0)]);
}

export class Plan {
  #kit;
  #buffers = [];
  #textures = [];
  #queries = null;
  #staging = new Map(); // what the host maps, by size

  constructor(kit) {
    this.#kit = kit;
  }

  /** A buffer for kernels that can also be written and read by the host. */
  buffer(label, bytes, usage = GPUBufferUsage.STORAGE | GPUBufferUsage.COPY_DST | GPUBufferUsage.COPY_SRC) {
    const size = Math.max(16, Math.ceil(bytes / 16) * 16);
    const buffer = this.#kit.device.createBuffer({ label, size, usage });
    this.#buffers.push(buffer);
    return buffer;
  }

  /** A texture for kernels, of four numbers a texel. */
  texture(label, width, height) {
    const usage = GPUTextureUsage.TEXTURE_BINDING | GPUTextureUsage.STORAGE_BINDING;
    const texture = this.#kit.device.createTexture({ label, size: [width, height], format: "rgba32float", usage });
    this.#textures.push(texture);
    return texture.createView();
  }

  /** A buffer that keeps these values. */
  constant(label, values) {
    const buffer = this.buffer(label, values.byteLength);
    this.#kit.device.queue.writeBuffer(buffer, 0, values);
    return buffer;
  }

  /** A uniform of these fields. */
  uniform(label, ...fields) {
    const bytes = packed(fields);
    const buffer = this.buffer(label, bytes.length, GPUBufferUsage.UNIFORM | GPUBufferUsage.COPY_DST);
    this.#kit.device.queue.writeBuffer(buffer, 0, bytes);
    return buffer;
  }

  /**
   * One dispatch.
   * @param {{stage: string, kernel: string, entry: string, constants?: Record<string, number>,
   *          bindings: Record<number, GPUBuffer | GPUTextureView | GPUSampler>, groups: number[]}} wanted
   */
  async step({ stage, kernel, entry, constants, bindings, groups }) {
    const pipeline = await this.#kit.pipeline(kernel, entry, constants, Object.keys(bindings).map(Number));
    const entries = Object.entries(bindings).map(([binding, bound]) => ({
      binding: Number(binding),
      resource: bound instanceof GPUBuffer ? { buffer: bound } : bound,
    }));
    const bindGroup = this.#kit.device.createBindGroup({ layout: pipeline.getBindGroupLayout(0), entries });
    return { stage, pipeline, bindGroup, groups };
  }

  /** Where the buffers that are read back lie in the one that the host maps. */
  #readback(reads) {
    let at = 0;
    const places = reads.map((read) => {
      const place = { ...read, at };
      at += Math.ceil(read.bytes / 16) * 16;
      return place;
    });
    return { places, queries: at, bytes: at + (this.#kit.hasTimestamps ? QUERY_BYTES : 0) };
  }

  #querySet() {
    if (!this.#queries && this.#kit.hasTimestamps)
      this.#queries = {
        set: this.#kit.device.createQuerySet({ type: "timestamp", count: 2 * MOST_PASSES }),
        buffer: this.buffer("times", QUERY_BYTES, GPUBufferUsage.QUERY_RESOLVE | GPUBufferUsage.COPY_SRC),
      };
    return this.#queries;
  }

  /** Steps of one stage that follow each other share a pass. @returns the stages of the passes in order */
  #encodePasses(encoder, steps) {
    const stages = [];
    let pass = null;
    for (const step of steps) {
      if (stages.at(-1) !== step.stage) {
        pass?.end();
        const index = 2 * stages.length;
        const queries = this.#querySet();
        pass = encoder.beginComputePass({
          label: step.stage,
          timestampWrites: queries
            ? { querySet: queries.set, beginningOfPassWriteIndex: index, endOfPassWriteIndex: index + 1 }
            : undefined,
        });
        stages.push(step.stage);
      }
      pass.setPipeline(step.pipeline);
      pass.setBindGroup(0, step.bindGroup);
      pass.dispatchWorkgroups(...step.groups);
    }
    pass?.end();
    return stages;
  }

  #stagingOf(bytes) {
    if (!this.#staging.has(bytes))
      this.#staging.set(bytes, this.buffer("read", bytes, GPUBufferUsage.MAP_READ | GPUBufferUsage.COPY_DST));
    return this.#staging.get(bytes);
  }

  #submit(steps, clears, reads) {
    const { device } = this.#kit;
    const layout = this.#readback(reads);
    const target = this.#stagingOf(layout.bytes);
    const encoder = device.createCommandEncoder();
    for (const buffer of clears) encoder.clearBuffer(buffer);
    const stages = this.#encodePasses(encoder, steps);
    for (const { buffer, bytes, at } of layout.places)
      encoder.copyBufferToBuffer(buffer, 0, target, at, Math.ceil(bytes / 4) * 4);
    if (this.#queries) {
      encoder.resolveQuerySet(this.#queries.set, 0, 2 * stages.length, this.#queries.buffer, 0);
      encoder.copyBufferToBuffer(this.#queries.buffer, 0, target, layout.queries, 16 * stages.length);
    }
    device.queue.submit([encoder.finish()]);
    return { target, layout, stages };
  }

  /**
   * Clears some buffers, runs steps, and reads buffers back.
   * @param {{clears?: GPUBuffer[], reads: {buffer: GPUBuffer, bytes: number}[]}} wanted
   * @returns {Promise<{results: ArrayBuffer[], stages: {name: string, ms: number}[]}>}
   */
  async run(steps, { clears = [], reads }) {
    const start = performance.now();
    const { target, layout, stages } = await guarded(this.#kit.device, "a frame", () =>
      this.#submit(steps, clears, reads),
    );
    await target.mapAsync(GPUMapMode.READ);
    const done = performance.now();
    const mapped = target.getMappedRange();
    const results = layout.places.map(({ at, bytes }) => mapped.slice(at, at + bytes));
    const times = this.#queries ? new BigInt64Array(mapped.slice(layout.queries)) : null;
    target.unmap();
    const timed = times
      ? stages.map((name, i) => ({ name, ms: Number(times[2 * i + 1] - times[2 * i]) / 1e6 }))
      : [{ name: "solve", ms: done - start }];
    return { results, stages: [...timed, { name: "read", ms: performance.now() - done }] };
  }

  destroy() {
    for (const buffer of this.#buffers) buffer.destroy();
    for (const texture of this.#textures) texture.destroy();
    this.#queries?.set.destroy();
  }
}
