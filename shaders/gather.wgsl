// From R of level 1 to what pixels receive (src/holographic/gather.c): level 0 is traced as it is needed. A pixel takes
// the radiance of the next column, or quadrants would share the rays at 45 degrees; what lies between the two centres
// is in the way. The first steps of that column are weighed as the pixel sees them (src/holographic/strip.c). Groups
// are counted by column.

override MEDIA: bool = false; // some pixel is a medium
override ADD: bool = false; // the second quadrant of its axis adds to the first

@group(0) @binding(4) var<storage, read_write> sums: array<vec3f>; // [column][row], of one axis

// As in src/kernel/rows.h: the part of half a quadrant that a pixel two steps ahead fills.
const AHEAD: f32 = 0.40966796875;
const ASIDE: f32 = 1.0 - AHEAD;

// The first step of half a pixel's quadrant: what is seen on the way to its end, and the part that passes beside an end
// that is opaque.
struct Fork {
    seen: Interval,
    straight: vec3f,
}

fn passed_by(a: Interval) -> vec3f {
    return through(a, vec3f(1.0));
}

fn pixel_seen(x: i32, y: i32, chord: u32) -> Interval {
    return segment_of(half(fresh(), x, y, chord));
}

fn fork(x: i32, y: i32, up: i32) -> Fork {
    let start = pixel_seen(x, y, DIAGONAL);
    let ahead = pixel_seen(x + 1, y, POINT);
    let aside = pixel_seen(x, y + up, POINT);
    let end = pixel_seen(x + 1, y + up, DIAGONAL);
    let nearer = AHEAD * passed_by(ahead);
    let low = nearer * passed_by(pixel_seen(x + 1, y + up, POINT));
    let high = ASIDE * passed_by(aside);
    let light = (AHEAD * light_of(ahead) + ASIDE * light_of(aside)) + (low * light_of(end) + high * light_of(end));
    return Fork(interval_of(light_of(start) + through(start, light),
                            passed_by(start) * ((low + high) * passed_by(end))),
                passed_by(start) * (nearer - low));
}

// Two pixels along and two across, by the pixel aside; from there on by both ways.
fn cross_aside_beside(x: i32, y: i32, up: i32, other: bool) -> Interval {
    var v = half(half(fresh(), x, y, DIAGONAL), x, y + up, POINT);
    v = full(v, x + 1, y + up, DIAGONAL);
    return segment_of(half(corner(v, x + 2, y + 2 * up, up, other), x + 2, y + 2 * up, DIAGONAL));
}

fn cross_aside(x: i32, y: i32, up: i32) -> Interval {
    return mean_of(cross_aside_beside(x, y, up, false), cross_aside_beside(x, y, up, true));
}

// Adds to pixel (x, y) the light that the next column received.
fn receive(x: i32, y: i32, received: vec3f) {
    var light = select(sky, received, x + 1 < quadrant.width);
    if (MEDIA) {
        let step = cross_straight(x, y, 1);
        light = light_of(step) + through(step, light);
    }
    let at = world_column(x) * quadrant.length + y;
    if (ADD) {
        light += sums[at];
    }
    sums[at] = light;
}

// Pixels before odd columns.
@compute @workgroup_size(GROUP)
fn receive_odd(@builtin(local_invocation_index) first: u32, @builtin(workgroup_id) id: vec3u) {
    let q = i32(id.x); // column of level 1 that the odd one lies in
    let rows = rows_of(q + 1, quadrant.columns_above);
    let there = cone_at(2, q + 1, 0);
    let weight = weights[1];
    for (var y = i32(first); y < quadrant.length; y += ROW_STEP) {
        var low = Fork(nothing(), vec3f(0.0));
        var high = low;
        for (var traced = is_near(2 * q + 1, y, 1); traced; traced = false) { // a branch, as in strip.wgsl
            low = fork(2 * q + 1, y, -1);
            high = fork(2 * q + 1, y, 1);
            count(1, 2u);
        }
        let beyond_low = through(low.seen, light_above(there, y - 1, rows)) +
                         low.straight * light_above(there, y, rows);
        let beyond_high = through(high.seen, light_above(there + quadrant.length, y + 1, rows)) +
                          high.straight * light_above(there + quadrant.length, y, rows);
        receive(2 * q, y, weighed(weight.x, low.seen, beyond_low) + weighed(weight.y, high.seen, beyond_high));
    }
}

// Pixels before even columns.
@compute @workgroup_size(GROUP)
fn receive_even(@builtin(local_invocation_index) first: u32, @builtin(workgroup_id) id: vec3u) {
    let q = i32(id.x) + 1; // of level 1
    let rows = rows_of(q + 1, quadrant.columns_above);
    let here = cone_at(2, q, 0);
    let there = cone_at(2, q + 1, 0);
    let weight = 0.5 * weights[1];
    for (var y = i32(first); y < quadrant.length; y += ROW_STEP) {
        var low = nothing();
        var high = nothing();
        for (var traced = is_near(2 * q, y, 2); traced; traced = false) {
            low = cross_aside(2 * q, y, -1);
            high = cross_aside(2 * q, y, 1);
            count(2, 2u);
        }
        let beyond_low = through(low, light_above(there, y - 2, rows)) + above[here + y];
        let beyond_high = through(high, light_above(there + quadrant.length, y + 2, rows)) +
                          above[here + quadrant.length + y];
        receive(2 * q - 1, y, weighed(weight.x, low, beyond_low) + weighed(weight.y, high, beyond_high));
    }
}
