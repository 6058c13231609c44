// T of levels 0 to 2, traced through pixels. An item is a row; groups are counted by column in z. A
// kernel for each ray: it knows which pixels it crosses.

override REACH: i32 = 1; // of the level
override RISE: i32 = 1; // of the ray

@group(0) @binding(2) var<storage, read_write> segments: array<Interval>; // of the quadrant's level

@compute @workgroup_size(GROUP)
fn trace(@builtin(global_invocation_id) id: vec3u) {
    let y = i32(id.x);
    if (y >= quadrant.length) {
        return;
    }
    let p = quadrant.first + i32(id.z) * quadrant.stride;
    segments[segment_at(REACH, p, (RISE + REACH) / 2) + y] = cross(p * REACH, y, REACH, RISE);
}
