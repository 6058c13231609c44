// From R of level 1 to what pixels receive (src/holographic/gather.c): level 0 is traced as it is needed. A pixel takes
// the radiance of the next column, or quadrants would share the rays at 45 degrees; what lies between the two centres
// is in the way. Groups are counted by column and window of blocks; blocks from which nothing is near are worked off
// first, without looking.

override MEDIA: bool = false; // some pixel is a medium
override ADD: bool = false; // the second quadrant of its axis adds to the first
override REACH: i32 = 1; // of the rays: 1 from odd columns, 2 from even ones, which level 1 has, too

@group(0) @binding(4) var sums: texture_storage_2d<rgba32float, write>; // [column][row], of one axis
@group(0) @binding(11) var first_sums: texture_2d<f32>; // what the first quadrant received

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

// What a column receives whose two rays meet this.
fn received_at(cone: Cone, y: i32, low: Interval, high: Interval) -> vec3f {
    var beyond_low = through(low, light_beyond(cone.end, cone.end.low, y - REACH));
    var beyond_high = through(high, light_beyond(cone.end, cone.end.high, y + REACH));
    if (REACH == 2) {
        beyond_low += light_at(cone.here, cone.here.low, y);
        beyond_high += light_at(cone.here, cone.here.high, y);
    }
    return weighed(cone.weight.x, low, beyond_low) + weighed(cone.weight.y, high, beyond_high);
}

// Adds to pixel (x, y) the light that the next column received.
fn give(x: i32, y: i32, received: vec3f, behind: vec3f) {
    var light = select(behind, received, x + 1 < quadrant.width);
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
            give(column - 1, y, received_at(cone, y, nothing(), nothing()), cone.end.sky);
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
    left = some_of(found);
    loop {
        let block = lowest(left);
        let begin = (first + number_of(block)) * BLOCK + first_row(lane);
        var y = begin;
        loop {
            let low = cross(column, y, REACH, -REACH);
            let high = cross(column, y, REACH, REACH);
            give(column - 1, y, received_at(cone, y, low, high), cone.end.sky);
            count(REACH, select(0u, 2u, is_any(found) & (y < quadrant.length)));
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
}
