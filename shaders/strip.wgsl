// T of levels 0 to 2, traced through pixels. An item is a row; groups are counted by ray and column.

@group(0) @binding(2) var<storage, read_write> segments: array<Interval>; // of the quadrant's level
@group(0) @binding(3) var<storage, read_write> counters: array<atomic<u32>>; // segments, by level

@compute @workgroup_size(GROUP)
fn trace(@builtin(global_invocation_id) id: vec3u) {
    let y = i32(id.x);
    if (y >= quadrant.length) {
        return;
    }
    let k = i32(id.y);
    let p = i32(quadrant.first + id.z * quadrant.stride);
    let reach = 1 << quadrant.level;
    segments[segment_at(quadrant.level, p, k, y)] = cross(p << quadrant.level, y, reach, 2 * k - reach);
    atomicAdd(&counters[quadrant.level], 1u);
}
