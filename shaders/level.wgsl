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
    radius: f32, // of the beam around the rays of a slot of a block, where they begin [px]
    widening: f32, // of the beam, per pixel
}

override MERGE: u32 = 0u; // one of the following
const TOP: u32 = 0u; // there is no level above, only the sky
const BILINEAR: u32 = 1u;
const BILINEAR_FIX: u32 = 2u;
const NEAREST_FIX: u32 = 3u;

const BRANCHING: u32 = 4u; // rays of a slot
const CORNERS: u32 = 4u; // parents of a block, and its probes
const SHORTEST_MOVE: f32 = 8.0; // of a beam [px]; more than the reach of level 0, whose rays go all ways

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
    free: f32, // share of their way on which rays of the slot meet nothing
    turns: u32, // probes to trace: all, or one where rays meet nothing
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

fn all_by(light: Four, share: f32) -> Four {
    return Four(light.a * share, light.b * share, light.c * share, light.d * share);
}

fn sum_of(x: Four, y: Four) -> Four {
    return Four(x.a + y.a, x.b + y.b, x.c + y.c, x.d + y.d);
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
    return all_by(sum, 1.0 / f32(group.slot_count));
}

fn probe_at(block: Block, corner: u32) -> vec2f {
    return block.position + vec2f(side_of(corner)) * level.spacing;
}

// The share of their way on which rays of a slot of a block meet nothing: 1 where they meet nothing at all. A beam, wide
// enough for all of them, is moved forward as long as there is room for it.
fn free_share(middle: vec2f, slot: u32, walk: Walk) -> f32 {
    let direction = directions[level.first_direction + BRANCHING * (2u * slot + 1u)];
    let reach = level.t1 - level.t0;
    let start = middle + direction * level.t0;
    var t = 0.0;
    var goes_on: bool;
    loop {
        let at = start + t * direction;
        let radius = level.radius + t * level.widening;
        let room = textureSampleLevel(grid, nearest, (floor(at) + 1.5) * walk.texel, 0.0).w - TWO_HALF_DIAGONALS;
        let landed = t + (room - radius) / (1.0 + level.widening);
        let leaves = !ENTERS & (any(at < vec2f(-radius)) | any(at > walk.size + radius));
        goes_on = (landed >= min(t + SHORTEST_MOVE, reach)) & !leaves;
        t = select(select(t, landed, goes_on), reach, leaves);
        continuing {
            break if !(goes_on & (t < reach));
        }
    }
    return min(t / reach, 1.0);
}

// Where rays of a probe end, if they go on for t1 from there.
fn aim_of(block: Block, corner: u32, parent: u32) -> vec2f {
    if (MERGE == BILINEAR_FIX) {
        return probe_position(parent_at(block, parent), 2.0 * level.spacing);
    }
    if (MERGE == NEAREST_FIX) { // the nearest parent of a probe is the one at the same corner
        return probe_position(parent_at(block, corner), 2.0 * level.spacing);
    }
    return probe_at(block, corner);
}

// From each probe's t0 to t1 along the way from its aim; then what is behind. The four change places at each turn and are
// back at theirs after all. Where there is nothing to meet one turn is one too many, but a loop has no fewer.
fn trace(block: Block, group: Group, parent: u32, beyond: Four) -> Four {
    var light = beyond;
    var corner = 0u;
    loop {
        let start = probe_at(block, corner) + group.direction * level.t0;
        let seen = march(start, aim_of(block, corner, parent) + group.direction * level.t1, block.free, block.walk);
        light = Four(light.b, light.c, light.d, seen.radiance + seen.passed * light.a);
        continuing {
            corner++;
            break if corner >= block.turns;
        }
    }
    let is_near = block.turns == CORNERS;
    return Four(select(beyond.a, light.a, is_near), select(beyond.b, light.b, is_near),
                select(beyond.c, light.c, is_near), select(beyond.d, light.d, is_near));
}

// Rays of their own for a parent, which end where that parent's begin, so that the two join without a seam; weighted.
fn trace_to_parent(block: Block, group: Group, parent: u32) -> Four {
    let beyond = mean_above(block, group, parent_at(block, parent));
    let light = trace(block, group, parent, Four(beyond, beyond, beyond, beyond));
    let is_upper = side_of(parent) == vec2i(1);
    let lower = select(vec2f(1.0 - LOWER_SHARE), vec2f(LOWER_SHARE), is_upper); // for lower probes
    let upper = select(vec2f(1.0 - UPPER_SHARE), vec2f(UPPER_SHARE), is_upper);
    return Four(light.a * (lower.x * lower.y * group.share), light.b * (upper.x * lower.y * group.share),
                light.c * (lower.x * upper.y * group.share), light.d * (upper.x * upper.y * group.share));
}

fn trace_to_all_parents(sum: Four, block: Block, group: Group) -> Four {
    var light = sum;
    var parent = 0u;
    loop {
        light = sum_of(light, trace_to_parent(block, group, parent));
        continuing {
            parent++;
            break if parent >= CORNERS;
        }
    }
    return light;
}

fn light_behind(block: Block, group: Group) -> Four {
    if (MERGE == BILINEAR) {
        return mean_between(block, group);
    }
    if (MERGE == NEAREST_FIX) {
        return Four(mean_above(block, group, parent_at(block, 0u)), mean_above(block, group, parent_at(block, 1u)),
                    mean_above(block, group, parent_at(block, 2u)), mean_above(block, group, parent_at(block, 3u)));
    }
    return Four(sky, sky, sky, sky);
}

fn add_group(sum: Four, block: Block, group: Group) -> Four {
    if (MERGE == BILINEAR_FIX) {
        return trace_to_all_parents(sum, block, group);
    }
    return sum_of(sum, all_by(trace(block, group, 0u, light_behind(block, group)), group.share));
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
    let walk = walk_through(level.picture);
    let free = free_share(position + 0.5 * level.spacing, slot, walk);
    let block = Block(lower, position, texel_of(above), free, select(1u, CORNERS, free < 1.0), walk);
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
