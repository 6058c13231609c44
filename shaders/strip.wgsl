// T of levels 1 and 2, traced through pixels (src/holographic/strip.c). Groups are counted by column. A kernel for each
// ray: it knows which pixels it crosses.

override REACH: i32 = 2; // of the level
override RISE: i32 = 2; // of the ray

@group(0) @binding(4) var<storage, read_write> segments: array<Interval>; // of the quadrant's level

@compute @workgroup_size(GROUP)
fn trace(@builtin(local_invocation_index) first: u32, @builtin(workgroup_id) id: vec3u) {
    let p = quadrant.first + i32(id.x) * quadrant.stride;
    let x = p * REACH;
    let out = segment_at(REACH, p, (RISE + REACH) / 2);
    for (var y = i32(first); y < quadrant.length; y += ROW_STEP) {
        var seen = nothing();
        // A branch. Written as a loop it is skipped by what runs rows in lockstep, where no row needs it.
        for (var traced = is_near(x, y, REACH); traced; traced = false) {
            seen = cross(x, y, REACH, RISE);
            count(REACH, 1u);
        }
        segments[out + y] = seen;
    }
}
