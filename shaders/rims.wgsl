// Light from near (src/holographic/rims.c): what a pixel receives straight from lamps a few pixels away, as the truth
// finds it. finish.wgsl takes it off before the filter and puts it back after.

// Near is what is at most so many rows and columns away.
const NEAR: i32 = 7;
const SIDE: i32 = 2 * NEAR + 1;
const DIRECTIONS: f32 = 120.0;
const RADIANCE_MAX: f32 = 1e37;

@group(0) @binding(5) var<storage, read> sights: array<vec4u>; // [dy][dx]: directions, a bit each
@group(0) @binding(7) var<storage, read_write> near: array<vec4f>; // light, and the share of directions it comes from

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

// Pixels on a rim, and those beside one, which the filter of that reads.
@compute @workgroup_size(GROUP)
fn look(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u,
        @builtin(local_invocation_index) local: u32) {
    let pixel = item_of(group, groups, local);
    if (pixel >= picture.size.x * picture.size.y || emission[pixel].w == OPAQUE) {
        return;
    }
    let y = i32(pixel / picture.size.x);
    let x = i32(pixel) - y * i32(picture.size.x);
    if (is_beside_lamps(x, y, RIM + 1)) {
        near[pixel] = light_from_near(x, y);
    }
}
