// Light from near (src/holographic/rims.c): what a pixel receives straight from lamps a few pixels away, as the truth
// finds it. Part of finish.wgsl, which takes it off before the filter and puts it back after.

// Near is what is at most so many rows and columns away, and the rim of a lamp what is at most so many from it.
const NEAR: i32 = 7;
const RIM: i32 = 2;
const SIDE: i32 = 2 * NEAR + 1;
const DIRECTIONS: f32 = 120.0;
const RADIANCE_MAX: f32 = 1e37;

@group(0) @binding(5) var<storage, read> sights: array<vec4u>; // [dy][dx]: directions, a bit each
@group(0) @binding(6) var<storage, read> clearance: array<f32>; // as distance.wgsl leaves it

fn is_opaque(x: i32, y: i32) -> bool {
    let size = vec2i(picture.size);
    if (x < 0 || y < 0 || x >= size.x || y >= size.y) {
        return false;
    }
    return emission[y * size.x + x].w == OPAQUE;
}

fn is_lamp(x: i32, y: i32) -> bool {
    return is_opaque(x, y) && any(emission[y * i32(picture.size.x) + x].rgb > vec3f(0.0));
}

fn is_on_rim(x: i32, y: i32) -> bool {
    if (clearance[y * i32(picture.size.x) + x] > 2.0 * f32(RIM)) {
        return false;
    }
    for (var dy = -RIM; dy <= RIM; dy++) {
        for (var dx = -RIM; dx <= RIM; dx++) {
            if (is_lamp(x + dx, y + dy)) {
                return true;
            }
        }
    }
    return false;
}

struct Looker {
    open: vec4u, // directions in which nothing was met so far
    light: vec4f, // and in w the share of directions that it comes from
}

fn meet(looker: ptr<function, Looker>, x: i32, y: i32, dx: i32, dy: i32) {
    if (!is_opaque(x + dx, y + dy)) {
        return;
    }
    let seen = sights[(dy + NEAR) * SIDE + dx + NEAR] & (*looker).open;
    (*looker).open ^= seen;
    let counts = countOneBits(seen);
    let share = f32(counts.x + counts.y + counts.z + counts.w) / DIRECTIONS;
    let shown = emission[(y + dy) * i32(picture.size.x) + x + dx].rgb;
    (*looker).light += share * vec4f(min(shown, vec3f(RADIANCE_MAX)), f32(any(shown > vec3f(0.0))));
}

// Rows and columns outwards: what is nearer hides what is further.
fn light_from_near(x: i32, y: i32) -> vec4f {
    var looker = Looker(vec4u(0xffffffffu), vec4f(0.0));
    for (var row = 0; row < SIDE && any(looker.open != vec4u(0u)); row++) {
        let reach = (row + 1) / 2;
        let dy = select(reach, -reach, row % 2 == 0);
        for (var dx = 0; dx <= NEAR; dx++) {
            meet(&looker, x, y, dx, dy);
        }
        for (var dx = -1; dx >= -NEAR; dx--) {
            meet(&looker, x, y, dx, dy);
        }
    }
    return looker.light;
}

// What a pixel and its neighbours add up to.
struct Total {
    light: vec3f,
    near: vec3f,
    open: f32, // share of directions in which there is no lamp near
}

fn add(total: ptr<function, Total>, x: i32, y: i32, weight: f32) {
    let near = light_from_near(x, y);
    (*total).light += weight * at(x, y).rgb;
    (*total).near += weight * near.rgb;
    (*total).open += weight * (1.0 - near.w);
}

// Walls that touch at a corner let nothing through: between two of them no neighbour is reached.
fn is_reached(x: i32, y: i32, dx: i32, dy: i32) -> bool {
    return at(x + dx, y + dy).w * (at(x + dx, y).w + at(x, y + dy).w) > 0.0;
}

// Two neighbours opposite each other.
fn add_pair(total: ptr<function, Total>, x: i32, y: i32, dx: i32, dy: i32, weight: f32) {
    if (!is_reached(x, y, dx, dy) || !is_reached(x, y, -dx, -dy)) {
        return;
    }
    add(total, x + dx, y + dy, weight);
    add(total, x - dx, y - dy, weight);
}

// What comes from further away comes through what is open. Where there is less light than from near, there is a medium
// in between: what is left of it falls off all the same.
fn filter_rim(x: i32, y: i32) -> vec3f {
    let near = light_from_near(x, y);
    var total = Total(vec3f(0.0), vec3f(0.0), 0.0);
    add(&total, x, y, 4.0);
    add_pair(&total, x, y, 1, 0, 2.0);
    add_pair(&total, x, y, 0, 1, 2.0);
    add_pair(&total, x, y, 1, 1, 1.0);
    add_pair(&total, x, y, 1, -1, 1.0);
    let further = (total.light - total.near) * select(0.0, (1.0 - near.w) / total.open, total.open > 0.0);
    let left = total.light / max(total.near, vec3f(1e-37));
    return select(near.rgb + further, near.rgb * left, total.light < total.near);
}
