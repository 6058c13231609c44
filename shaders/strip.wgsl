// T of levels 0 to 2, traced through pixels. Groups are counted by column. A kernel for
// each ray: it knows which pixels it crosses.

override REACH: i32 = 1; // of the level
override RISE: i32 = 1; // of the ray

// Pixels further from where a segment starts are not on its way [reaches]: the diagonal, and a little.
const FURTHEST: f32 = 1.5;

@group(0) @binding(2) var<storage, read_write> segments: array<Interval>; // of the quadrant's level
@group(0) @binding(3) var<storage, read> clearance: array<f32>; // as distance.wgsl leaves it
@group(0) @binding(4) var<storage, read_write> counters: array<atomic<u32>>; // segments, by level

@compute @workgroup_size(GROUP)
fn trace(@builtin(local_invocation_index) first: u32, @builtin(workgroup_id) id: vec3u) {
    let p = quadrant.first + i32(id.x) * quadrant.stride;
    let x = p * REACH;
    let out = segment_at(REACH, p, (RISE + REACH) / 2);
    let pixel = world_column(x) * quadrant.pixel_x;
    for (var y = i32(first); y < quadrant.length; y += ROW_STEP) {
        var seen = nothing();
        let free = clearance[pixel + y * quadrant.pixel_y];
        // A branch. Written as a loop it is skipped by what runs rows in lockstep, where no row needs it.
        for (var is_near = free < FURTHEST * f32(REACH); is_near; is_near = false) {
            seen = cross(x, y, REACH, RISE);
            atomicAdd(&counters[firstTrailingBit(REACH)], 1u);
        }
        segments[out + y] = seen;
    }
}
