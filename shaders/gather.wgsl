// From R of level 1 to what pixels receive (src/holographic/gather.c): level 0 is traced as it is needed. A pixel takes
// the radiance of the next column, or quadrants would share the rays at 45 degrees; what lies between the two centres
// is in the way. The first steps of that column are weighed as the pixel sees them (src/holographic/strip.c). Groups
// are counted by column and window of blocks; blocks from which nothing is near are worked off first, without looking.

override MEDIA: bool = false; // some pixel is a medium
override ADD: bool = false; // the second quadrant of its axis adds to the first
override REACH: i32 = 1; // of the rays: 1 from odd columns, 2 from even ones, which level 1 has, too

@group(0) @binding(4) var sums: texture_storage_2d<rgba32float, write>; // [column][row], of one axis
@group(0) @binding(11) var first_sums: texture_2d<f32>; // what the first quadrant received

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

// The first step from a column on, upwards or downwards.
fn first_step(x: i32, y: i32, up: i32) -> Fork {
    if (REACH == 2) {
        return Fork(cross_aside(x, y, up), vec3f(0.0));
    }
    return fork(x, y, up);
}

// What lies behind the rays of a column: at their ends, and, of an even one, here.
struct Cone {
    end: Column,
    here: Column,
    weight: vec2f,
}

// q is the column of level 1 that the column is, or lies in.
fn cone_of(q: i32) -> Cone {
    let share = select(1.0, 0.5, REACH == 2);
    return Cone(column_of(2, q + 1, 0), column_of(2, q, 0), share * weights[1]);
}

// What comes to the column from behind its two steps.
struct Beyond {
    low: vec3f,
    high: vec3f,
}

fn beyond_of(cone: Cone, y: i32, low: Interval, high: Interval) -> Beyond {
    var beyond = Beyond(through(low, light_beyond(cone.end, cone.end.low, y - REACH)),
                        through(high, light_beyond(cone.end, cone.end.high, y + REACH)));
    if (REACH == 2) {
        beyond.low += light_at(cone.here, cone.here.low, y);
        beyond.high += light_at(cone.here, cone.here.high, y);
    }
    return beyond;
}

fn received_from(cone: Cone, low: Interval, high: Interval, beyond: Beyond) -> vec3f {
    return weighed(cone.weight.x, low, beyond.low) + weighed(cone.weight.y, high, beyond.high);
}

// What a column receives whose steps meet nothing.
fn received_clear(cone: Cone, y: i32) -> vec3f {
    return received_from(cone, nothing(), nothing(), beyond_of(cone, y, nothing(), nothing()));
}

fn received(cone: Cone, y: i32, low: Fork, high: Fork) -> vec3f {
    var beyond = beyond_of(cone, y, low.seen, high.seen);
    if (REACH == 1) {
        beyond.low += low.straight * light_beyond(cone.end, cone.end.low, y);
        beyond.high += high.straight * light_beyond(cone.end, cone.end.high, y);
    }
    return received_from(cone, low.seen, high.seen, beyond);
}

// Adds to pixel (x, y) the light that the next column received.
fn give(x: i32, y: i32, found: vec3f, behind: vec3f) {
    var light = select(behind, found, x + 1 < quadrant.width);
    if (MEDIA) {
        let step = cross_straight(x, y, 1);
        light = light_of(step) + through(step, light);
    }
    let column = world_column(x);
    if (ADD) {
        let texel = texel_of(first_sums);
        let at = vec2f(middle_of(y, texel.x), middle_of(column, texel.y));
        light += textureSampleLevel(first_sums, nearest, at, 0.0).rgb;
    }
    textureStore(sums, vec2i(kept_at(y, true), column), vec4f(light, 0.0));
}

// Pixels before odd or even columns.
@compute @workgroup_size(LANES)
fn receive(@builtin(local_invocation_index) lane: u32, @builtin(workgroup_id) id: vec3u) {
    let q = quadrant.first + i32(id.x);
    let column = 2 * q + 2 - REACH;
    let first = i32(id.y) * WINDOW;
    let cone = cone_of(q);
    let found = near_of(column, first, REACH - 1);

    var left = some_of(window_to(count_of_blocks() - first) & ~found);
    loop {
        let block = lowest(left);
        let begin = (first + number_of(block)) * BLOCK + first_row(lane);
        var y = begin;
        loop {
            give(column - 1, y, received_clear(cone, y), cone.end.sky);
            continuing {
                y += ROW_STEP;
                break if y == begin + ROWS * ROW_STEP;
            }
        }
        continuing {
            left ^= block;
            break if !is_any(left);
        }
    }
    var traced = 0u;
    left = some_of(found);
    loop {
        let block = lowest(left);
        let begin = (first + number_of(block)) * BLOCK + first_row(lane);
        var y = begin;
        loop {
            let light = received(cone, y, first_step(column, y, -1), first_step(column, y, 1));
            give(column - 1, y, light, cone.end.sky);
            traced += select(0u, 2u, y < quadrant.length);
            continuing {
                y += ROW_STEP;
                break if y == begin + ROWS * ROW_STEP;
            }
        }
        continuing {
            left ^= block;
            break if !is_any(left);
        }
    }
    count(REACH, select(0u, traced, is_any(found)));
}
