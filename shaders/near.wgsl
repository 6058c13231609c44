// Which pixels a segment of level 0, 1, 2 or 3 may meet anything from: a bit for each block of a column, by the distance
// field. strip.wgsl and gather.wgsl trace nothing else.

struct World {
    size: vec2i, // along the axis and across it [px]
    steps: vec2i, // from a pixel to the next, along and across
    words: i32, // of the blocks of a column
}

const BLOCK: i32 = 16; // as in quadrant.wgsl
const WORD: i32 = 32;
const FAR: f32 = 1e9;

// Pixels further from where a segment starts are not on its way [reaches]: the diagonal, and a little.
const FURTHEST: f32 = 1.5;

@group(0) @binding(0) var<uniform> world: World;
@group(0) @binding(1) var<storage, read> clearance: array<f32>; // as distance.wgsl leaves it
@group(0) @binding(2) var<storage, read_write> near: array<vec4u>; // [column][word]: level by level

// An item is a word.
@compute @workgroup_size(GROUP)
fn find(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u,
        @builtin(local_invocation_index) local: u32) {
    let item = i32(item_of(group, groups, local));
    if (item >= world.size.x * world.words) {
        return;
    }
    let x = item / world.words;
    let first = (item - x * world.words) * WORD * BLOCK;
    var found = vec4u(0u);
    for (var block = 0; block < WORD; block++) {
        var clear = FAR;
        for (var i = 0; i < BLOCK; i++) {
            let y = first + block * BLOCK + i;
            let here = clearance[x * world.steps.x + min(y, world.size.y - 1) * world.steps.y];
            clear = select(clear, min(clear, here), y < world.size.y);
        }
        let is_near = vec4f(clear) < FURTHEST * vec4f(1.0, 2.0, 4.0, 8.0);
        found |= select(vec4u(0u), vec4u(1u << u32(block)), is_near);
    }
    near[item] = found;
}
