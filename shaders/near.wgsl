// Which pixels a segment of level 0, 1, 2 or 3 of a quadrant may meet anything from: a bit for each block of a column.
// strip.wgsl and gather.wgsl trace nothing else.

struct Quadrant {
    width: i32, // along the gather axis [px]
    words: i32, // of the blocks of a column
    mirrored: i32, // 1: x counts from the far end
}

@group(0) @binding(0) var<uniform> quadrant: Quadrant;
// [column of the world][word of blocks]: a bit for each four pixels, set where any is not empty
@group(0) @binding(1) var<storage, read> occupied: array<vec4u>;
@group(0) @binding(2) var<storage, read_write> near: array<vec4u>; // [column of the quadrant][word]: level by level

// Four pixels a bit, of a word of blocks, with the words before and behind it.
struct Units {
    before: vec4u,
    here: vec4u,
    after: vec4u,
}

fn word_at(x: i32, word: i32) -> vec4u {
    let column = select(x, quadrant.width - 1 - x, quadrant.mirrored != 0);
    let is_inside = (x < quadrant.width) & (u32(word) < u32(quadrant.words));
    return select(vec4u(0u), occupied[column * quadrant.words + word], is_inside);
}

fn add_column(units: Units, x: i32, word: i32) -> Units {
    return Units(units.before | word_at(x, word - 1), units.here | word_at(x, word),
                 units.after | word_at(x, word + 1));
}

// Those that have a set one at most `by` after or before them.
fn spread(units: Units, by: u32) -> vec4u {
    let up = (units.here << vec4u(by)) | (vec4u(units.before.w, units.here.xyz) >> vec4u(32u - by));
    let down = (units.here >> vec4u(by)) | (vec4u(units.here.yzw, units.after.x) << vec4u(32u - by));
    return units.here | up | down;
}

// A bit for each block of four units.
fn blocks_of(units: vec4u) -> u32 {
    var blocks = 0u;
    for (var i = 0u; i < 8u; i++) {
        let found = ((units >> vec4u(4u * i)) & vec4u(15u)) != vec4u(0u);
        let bits = select(vec4u(0u), vec4u(1u, 0x100u, 0x10000u, 0x1000000u) << vec4u(i), found);
        blocks |= bits.x | bits.y | bits.z | bits.w;
    }
    return blocks;
}

// An item is a word. A segment of level n crosses columns x to x + 2^n, and as many rows up or down.
@compute @workgroup_size(GROUP)
fn find(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u,
        @builtin(local_invocation_index) local: u32) {
    let item = i32(item_of(group, groups, local));
    if (item >= quadrant.width * quadrant.words) {
        return;
    }
    let x = item / quadrant.words;
    let word = item - x * quadrant.words;
    var units = add_column(Units(vec4u(0u), vec4u(0u), vec4u(0u)), x, word);
    var found = vec4u(0u);
    var column = 1;
    for (var level = 0; level < 4; level++) {
        for (; column <= 1 << u32(level); column++) {
            units = add_column(units, x + column, word);
        }
        found[level] = blocks_of(spread(units, 1u) | select(vec4u(0u), spread(units, 2u), level == 3));
    }
    near[item] = found;
}
