// From R of level 1 to what pixels receive (src/holographic/gather.c): level 0 is traced as it is needed. A pixel takes
// the radiance of the next column, or quadrants would share the rays at 45 degrees; what lies between the two centres
// is in the way. Groups are counted by column and word of blocks;
// blocks from which nothing is near are worked off first, without looking.

override MEDIA: bool = false; // some pixel is a medium
override ADD: bool = false; // the second quadrant of its axis adds to the first

@group(0) @binding(4) var<storage, read_write> sums: array<vec3f>; // [column][row], of one axis

// Adds to pixel (x, y) the light that the next column received.
fn receive(x: i32, y: i32, received: vec3f, behind: vec3f, is_meant: bool) {
    var light = select(behind, received, x + 1 < quadrant.width);
    if (MEDIA) {
        let step = cross_straight(x, y, 1);
        light = light_of(step) + through(step, light);
    }
    if (is_meant & (y < quadrant.length)) {
        let at = world_column(x) * quadrant.length + y;
        if (ADD) {
            light += sums[at];
        }
        sums[at] = light;
    }
}

// What lies behind the rays of a column whose level 1 is column q, and there.
struct Cone {
    end: Column,
    here: Column,
    weight: vec2f,
}

fn cone_of(q: i32, share: f32) -> Cone {
    return Cone(column_of(2, q + 1, 0), column_of(2, q, 0), share * weights[1]);
}

fn receive_odd_at(cone: Cone, x: i32, y: i32, low: Interval, high: Interval, is_meant: bool) {
    let beyond_low = through(low, light_beyond(cone.end, cone.end.low, y - 1));
    let beyond_high = through(high, light_beyond(cone.end, cone.end.high, y + 1));
    let received = weighed(cone.weight.x, low, beyond_low) + weighed(cone.weight.y, high, beyond_high);
    receive(x, y, received, cone.end.sky, is_meant);
}

fn receive_even_at(cone: Cone, x: i32, y: i32, low: Interval, high: Interval, is_meant: bool) {
    let beyond_low =
        through(low, light_beyond(cone.end, cone.end.low, y - 2)) + light_at(cone.here, cone.here.low, y);
    let beyond_high =
        through(high, light_beyond(cone.end, cone.end.high, y + 2)) + light_at(cone.here, cone.here.high, y);
    let received = weighed(cone.weight.x, low, beyond_low) + weighed(cone.weight.y, high, beyond_high);
    receive(x, y, received, cone.end.sky, is_meant);
}

// Pixels before odd columns.
@compute @workgroup_size(LANES)
fn receive_odd(@builtin(local_invocation_index) lane: u32, @builtin(workgroup_id) id: vec3u) {
    let q = i32(id.x); // column of level 1 that the odd one lies in
    let x = 2 * q;
    let first = i32(id.y) * WINDOW;
    let cone = cone_of(q, 1.0);
    let found = near_of(x + 1, first, 0);
    let clear = window_to(count_of_blocks() - first) & ~found;

    var left = some_of(clear);
    loop {
        let block = lowest(left);
        let begin = (first + number_of(block)) * BLOCK + first_row(lane);
        var y = begin;
        loop {
            receive_odd_at(cone, x, y, nothing(), nothing(), is_any(clear));
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
            receive_odd_at(cone, x, y, cross(x + 1, y, 1, -1), cross(x + 1, y, 1, 1), is_any(found));
            count(1, select(0u, 2u, is_any(found) & (y < quadrant.length)));
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

// Pixels before even columns.
@compute @workgroup_size(LANES)
fn receive_even(@builtin(local_invocation_index) lane: u32, @builtin(workgroup_id) id: vec3u) {
    let q = i32(id.x) + 1; // of level 1
    let x = 2 * q - 1;
    let first = i32(id.y) * WINDOW;
    let cone = cone_of(q, 0.5);
    let found = near_of(x + 1, first, 1);
    let clear = window_to(count_of_blocks() - first) & ~found;

    var left = some_of(clear);
    loop {
        let block = lowest(left);
        let begin = (first + number_of(block)) * BLOCK + first_row(lane);
        var y = begin;
        loop {
            receive_even_at(cone, x, y, nothing(), nothing(), is_any(clear));
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
            receive_even_at(cone, x, y, cross(x + 1, y, 2, -2), cross(x + 1, y, 2, 2), is_any(found));
            count(2, select(0u, 2u, is_any(found) & (y < quadrant.length)));
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
