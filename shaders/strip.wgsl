// T of levels 1 and 2, traced through pixels (src/holographic/strip.c). Groups are counted by column and word. A kernel
// for each ray: it knows which pixels it crosses.

override REACH: i32 = 2; // of the level
override RISE: i32 = 2; // of the ray

@group(0) @binding(4) var<storage, read_write> segments: array<Interval>; // of the quadrant's level
@group(0) @binding(5) var<storage, read_write> traced_blocks: array<u32>; // of those: [row][word]

@compute @workgroup_size(BLOCK)
fn trace(@builtin(local_invocation_index) local: u32, @builtin(workgroup_id) id: vec3u) {
    let lane = i32(local);
    let p = quadrant.first + i32(id.x) * quadrant.stride;
    let word = i32(id.y);
    let x = p * REACH;
    let row = row_of(REACH, p, (RISE + REACH) / 2);
    let found = near_of(x, word, REACH / 2);
    traced_blocks[row * quadrant.words + word] = found;
    var left = some_of(found);
    loop {
        let y = row_in(word, left, lane);
        let seen = cross(x, y, REACH, RISE);
        if (y < quadrant.length) {
            segments[row * quadrant.length + y] = seen;
            count(REACH, min(found, 1u));
        }
        continuing {
            left &= left - 1u;
            break if left == 0u;
        }
    }
}
