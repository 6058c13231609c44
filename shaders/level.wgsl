// A level of radiance cascades (src/cascade/level.c): for a slot of a probe, march the slot's rays over their interval, put
// the level above behind what they let through, and store the mean. Part of clear.wgsl and trace.wgsl, which do it in turn,
// level by level, the top one first.
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

@group(0) @binding(0) var<uniform> level: Level;
@group(0) @binding(4) var<storage, read> directions: array<vec2f>; // in steps of half a ray: ray k points along 2k+1
@group(0) @binding(5) var above: texture_2d<f32>; // as `radiance`
@group(0) @binding(6) var radiance: texture_storage_2d<rgba32float, write>; // 2^level x 2^level slots, each a picture of probes
@group(0) @binding(8) var<uniform> rule: SkipRule; // the same for all levels of a frame
@group(0) @binding(9) var<uniform> sky: vec3f;

struct Block {
    slot: u32,
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

// An item whose rays may meet something.
struct Near {
    item: u32,
    free: f32, // share of their way on which they meet nothing
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

fn between_all(parents: Four) -> Four {
    return Four(between(parents, vec2f(LOWER_SHARE, LOWER_SHARE)), between(parents, vec2f(UPPER_SHARE, LOWER_SHARE)),
                between(parents, vec2f(LOWER_SHARE, UPPER_SHARE)), between(parents, vec2f(UPPER_SHARE, UPPER_SHARE)));
}

fn item_count() -> u32 {
    return (level.blocks.x * level.blocks.y) << (2u * level.number);
}

fn block_of(item: u32) -> Block {
    let place = item >> (2u * level.number);
    let row = place / level.blocks.x;
    let lower = vec2i(i32(place - row * level.blocks.x), i32(row)) - 1;
    let position = probe_position(2 * lower + 1, level.spacing);
    return Block(item - (place << (2u * level.number)), lower, position, texel_of(above), walk_through(level.picture));
}

// Stores what a probe has, if it is wanted and there is that probe: 1, or 0.
fn keep(block: Block, corner: u32, light: vec3f, wanted: bool) -> u32 {
    let probe = 2 * block.lower + 1 + side_of(corner);
    let exists = wanted & all((probe >= vec2i(0)) & (probe < vec2i(level.probes)));
    let nobody_reads = vec2i(textureDimensions(radiance)) - 1;
    let at = select(nobody_reads, first_texel(block.slot, level.number, level.probes) + probe, exists);
    textureStore(radiance, at, vec4f(light, 0.0));
    return select(0u, 1u, exists);
}

fn keep_all(block: Block, light: Four, wanted: bool) -> u32 {
    return keep(block, 0u, light.a, wanted) + keep(block, 1u, light.b, wanted) + keep(block, 2u, light.c, wanted) +
           keep(block, 3u, light.d, wanted);
}
