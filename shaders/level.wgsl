// One level of radiance cascades: for a slot of a probe, march the slot's rays over their interval, put the level above
// behind what they let through, and store the mean (src/cascade/level.c). Dispatched once per level, the top one first.
//
// An item is a slot of a block: of the 2 x 2 probes that lie between the same four parents, whose light is loaded once
// for all of them. At the border of the picture blocks have probes that do not exist.

struct Level {
    picture: vec2u, // [px]
    probes: vec2u,
    above: vec2u, // probes of the level above
    blocks: vec2u,
    number: u32,
    first_direction: u32, // of this level in `directions`
    spacing: f32, // [px]
    t0: f32, // rays begin here [px]
    t1: f32, // and end here
}

override MERGE: u32 = 0u; // one of the following
const TOP: u32 = 0u; // there is no level above, only the sky
const BILINEAR: u32 = 1u;
const BILINEAR_FIX: u32 = 2u;
const NEAREST_FIX: u32 = 3u;

const BRANCHING: u32 = 4u; // rays of a slot
const CORNERS: u32 = 4u; // parents of a block, and its probes

@group(0) @binding(0) var<uniform> level: Level;
@group(0) @binding(4) var<storage, read> directions: array<vec2f>; // in steps of half a ray: ray k points along 2k+1
@group(0) @binding(5) var above: texture_2d<f32>; // as `radiance`
@group(0) @binding(6) var radiance: texture_storage_2d<rgba32float, write>; // 2^level x 2^level slots, each a picture of probes
@group(0) @binding(7) var<storage, read_write> counters: array<atomic<u32>>; // rays, by level
@group(0) @binding(8) var<uniform> rule: SkipRule; // the same for all levels of a frame
@group(0) @binding(9) var<uniform> sky: vec3f;

struct Block {
    lower: vec2i, // its first parent
    position: vec2f, // of its first probe [px]
    texel: vec2f, // of `above`
    walk: Walk,
}

// What belongs to the four probes of a block.
struct Four {
    a: vec3f, // lower in x and in y
    b: vec3f, // upper in x
    c: vec3f, // upper in y
    d: vec3f,
}

// Neighbouring rays of a slot that one traced ray stands for: it points to their middle and sees the mean of the slots
// above that they would have seen.
struct Group {
    direction: vec2f,
    first_slot: u32, // above
    slot_count: u32,
    share: f32, // of the slot
}

fn group_from(ray: u32, step: u32) -> Group {
    return Group(directions[level.first_direction + 2u * ray + step], ray, step, f32(step) / f32(BRANCHING));
}

// Lower or upper in x and y.
fn side_of(corner: u32) -> vec2i {
    return vec2i(i32(corner & 1u), i32(corner >> 1u));
}

// Where a slot of a level lies in its texture.
fn first_texel(slot: u32, number: u32, probes: vec2u) -> vec2i {
    return vec2i(vec2u(slot & ((1u << number) - 1u), slot >> number) * probes);
}

// Beyond the border the last parent stands in for those that are missing.
fn parent_at(block: Block, corner: u32) -> vec2i {
    return clamp(block.lower + side_of(corner), vec2i(0), vec2i(level.above) - 1);
}

fn read_above(block: Block, slot: u32, parent: vec2i) -> vec3f {
    let at = vec2f(first_texel(slot, level.number + 1u, level.above) + parent) + 0.5;
    return textureSampleLevel(above, nearest, at * block.texel, 0.0).rgb;
}

// What a group sees of one parent.
fn mean_above(block: Block, group: Group, parent: vec2i) -> vec3f {
    var sum = vec3f(0.0);
    var s = 0u;
    loop {
        sum += read_above(block, group.first_slot + s, parent);
        continuing {
            s++;
            break if s >= group.slot_count;
        }
    }
    return sum * (1.0 / f32(group.slot_count));
}

// Between the four parents, by the shares of the upper ones.
fn between(parents: Four, upper: vec2f) -> vec3f {
    let left = parents.a + (parents.c - parents.a) * upper.y;
    let right = parents.b + (parents.d - parents.b) * upper.y;
    return left + (right - left) * upper.x;
}

// What a group sees of all four of them.
fn mean_between(block: Block, group: Group) -> Four {
    var sum = Four(vec3f(0.0), vec3f(0.0), vec3f(0.0), vec3f(0.0));
    var s = 0u;
    loop {
        let slot = group.first_slot + s;
        let parents = Four(read_above(block, slot, parent_at(block, 0u)), read_above(block, slot, parent_at(block, 1u)),
                           read_above(block, slot, parent_at(block, 2u)), read_above(block, slot, parent_at(block, 3u)));
        sum.a += between(parents, vec2f(LOWER_SHARE, LOWER_SHARE));
        sum.b += between(parents, vec2f(UPPER_SHARE, LOWER_SHARE));
        sum.c += between(parents, vec2f(LOWER_SHARE, UPPER_SHARE));
        sum.d += between(parents, vec2f(UPPER_SHARE, UPPER_SHARE));
        continuing {
            s++;
            break if s >= group.slot_count;
        }
    }
    let share = 1.0 / f32(group.slot_count);
    return Four(sum.a * share, sum.b * share, sum.c * share, sum.d * share);
}

fn probe_at(block: Block, corner: u32) -> vec2f {
    return block.position + vec2f(side_of(corner)) * level.spacing;
}

// From the probe's t0 to t1 along the way from `aim`, which is the probe itself or a parent; then what is behind.
fn trace(block: Block, group: Group, probe: vec2f, aim: vec2f, beyond: vec3f) -> vec3f {
    let seen = march(probe + group.direction * level.t0, aim + group.direction * level.t1, block.walk);
    return seen.radiance + seen.passed * beyond;
}

fn trace_straight(block: Block, group: Group, corner: u32, beyond: vec3f) -> vec3f {
    let probe = probe_at(block, corner);
    return group.share * trace(block, group, probe, probe, beyond);
}

fn add_straight(sum: Four, block: Block, group: Group) -> Four {
    var beyond = Four(sky, sky, sky, sky);
    if (MERGE == BILINEAR) {
        beyond = mean_between(block, group);
    }
    return Four(sum.a + trace_straight(block, group, 0u, beyond.a), sum.b + trace_straight(block, group, 1u, beyond.b),
                sum.c + trace_straight(block, group, 2u, beyond.c), sum.d + trace_straight(block, group, 3u, beyond.d));
}

// Rays of their own for a parent, which end where that parent's begin, so that the two join without a seam.
fn add_to_parent(sum: Four, block: Block, group: Group, corner: u32) -> Four {
    let parent = parent_at(block, corner);
    let aim = probe_position(parent, 2.0 * level.spacing);
    let beyond = mean_above(block, group, parent);
    let is_upper = side_of(corner) == vec2i(1);
    let near = select(vec2f(1.0 - LOWER_SHARE), vec2f(LOWER_SHARE), is_upper); // weights for lower probes
    let far = select(vec2f(1.0 - UPPER_SHARE), vec2f(UPPER_SHARE), is_upper); // and for upper ones
    return Four(
        sum.a + near.x * near.y * group.share * trace(block, group, probe_at(block, 0u), aim, beyond),
        sum.b + far.x * near.y * group.share * trace(block, group, probe_at(block, 1u), aim, beyond),
        sum.c + near.x * far.y * group.share * trace(block, group, probe_at(block, 2u), aim, beyond),
        sum.d + far.x * far.y * group.share * trace(block, group, probe_at(block, 3u), aim, beyond));
}

fn add_to_all_parents(sum: Four, block: Block, group: Group) -> Four {
    var light = sum;
    var corner = 0u;
    loop {
        light = add_to_parent(light, block, group, corner);
        continuing {
            corner++;
            break if corner >= CORNERS;
        }
    }
    return light;
}

// The nearest parent of a probe is the one at the same corner of the block.
fn trace_to_nearest(block: Block, group: Group, corner: u32) -> vec3f {
    let parent = parent_at(block, corner);
    let aim = probe_position(parent, 2.0 * level.spacing);
    return group.share * trace(block, group, probe_at(block, corner), aim, mean_above(block, group, parent));
}

fn add_to_nearest(sum: Four, block: Block, group: Group) -> Four {
    return Four(sum.a + trace_to_nearest(block, group, 0u), sum.b + trace_to_nearest(block, group, 1u),
                sum.c + trace_to_nearest(block, group, 2u), sum.d + trace_to_nearest(block, group, 3u));
}

fn add_group(sum: Four, block: Block, group: Group) -> Four {
    if (MERGE == BILINEAR_FIX) {
        return add_to_all_parents(sum, block, group);
    }
    if (MERGE == NEAREST_FIX) {
        return add_to_nearest(sum, block, group);
    }
    return add_straight(sum, block, group);
}

// Stores what a probe has, if there is that probe: 1, or 0.
fn keep(slot: u32, block: Block, corner: u32, light: vec3f) -> u32 {
    let probe = 2 * block.lower + 1 + side_of(corner);
    let exists = all((probe >= vec2i(0)) & (probe < vec2i(level.probes)));
    let nobody_reads = vec2i(textureDimensions(radiance)) - 1;
    let at = select(nobody_reads, first_texel(slot, level.number, level.probes) + probe, exists);
    textureStore(radiance, at, vec4f(light, 0.0));
    return select(0u, 1u, exists);
}

@compute @workgroup_size(GROUP)
fn solve(@builtin(workgroup_id) workgroup: vec3u, @builtin(num_workgroups) groups: vec3u,
         @builtin(local_invocation_index) local: u32) {
    let item = item_of(workgroup, groups, local);
    let place = item >> (2u * level.number);
    let slot = item - (place << (2u * level.number));
    if (place >= level.blocks.x * level.blocks.y) {
        return;
    }
    let row = place / level.blocks.x;
    let lower = vec2i(i32(place - row * level.blocks.x), i32(row)) - 1;
    let position = probe_position(2 * lower + 1, level.spacing);
    let block = Block(lower, position, texel_of(above), walk_through(level.picture));
    let step = arcStep(level.number, rule);
    var sum = Four(vec3f(0.0), vec3f(0.0), vec3f(0.0), vec3f(0.0));
    var j = 0u;
    loop {
        sum = add_group(sum, block, group_from(slot * BRANCHING + j, step));
        continuing {
            j += step;
            break if j >= BRANCHING;
        }
    }
    let probes = keep(slot, block, 0u, sum.a) + keep(slot, block, 1u, sum.b) + keep(slot, block, 2u, sum.c) +
                 keep(slot, block, 3u, sum.d);
    let aims = select(1u, CORNERS, MERGE == BILINEAR_FIX);
    atomicAdd(&counters[level.number], probes * aims * (BRANCHING / step));
}
