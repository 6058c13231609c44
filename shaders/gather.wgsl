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

// What lies behind the cone of a column that is as wide as the quadrant.
struct Cone {
    here: i32,
    there: i32,
    rows: u32,
    weight: vec2f,
    behind: vec3f,
}

// q is a column of level 1.
fn cone_of(q: i32, share: f32) -> Cone {
    return Cone(cone_at(2, q, 0), cone_at(2, q + 1, 0), rows_of(q + 1, quadrant.columns_above), share * weights[1], sky);
}

fn receive_odd_at(cone: Cone, length: i32, x: i32, y: i32, low: Interval, high: Interval,
                   is_meant: bool) {
    let beyond_low = through(low, light_above(cone.behind, cone.there, y - 1, cone.rows));
    let beyond_high = through(high, light_above(cone.behind, cone.there + length, y + 1, cone.rows));
    let received = weighed(cone.weight.x, low, beyond_low) + weighed(cone.weight.y, high, beyond_high);
    receive(x, y, received, cone.behind, is_meant);
}

// Pixels before odd columns.
@compute @workgroup_size(BLOCK)
fn receive_odd(@builtin(local_invocation_index) local: u32, @builtin(workgroup_id) id: vec3u) {
    let lane = i32(local);
    let q = i32(id.x); // column of level 1 that the odd one lies in
    let word = i32(id.y);
    let x = 2 * q;
    let length = quadrant.length;
    let cone = cone_of(q, 1.0);
    let found = near_of(x + 1, word, 0);
    let clear = blocks_in(word) & ~found;

    var left = some_of(clear);
    loop {
        receive_odd_at(cone, length, x, row_in(word, left, lane), nothing(), nothing(), clear != 0u);
        continuing {
            left &= left - 1u;
            break if left == 0u;
        }
    }
    left = some_of(found);
    loop {
        let y = row_in(word, left, lane);
        receive_odd_at(cone, length, x, y, cross(x + 1, y, 1, -1), cross(x + 1, y, 1, 1), found != 0u);
        count(1, select(0u, 2u, (found != 0u) & (y < length)));
        continuing {
            left &= left - 1u;
            break if left == 0u;
        }
    }
}

fn receive_even_at(cone: Cone, length: i32, x: i32, y: i32, low: Interval, high: Interval,
                   is_meant: bool) {
    let beyond_low = through(low, light_above(cone.behind, cone.there, y - 2, cone.rows)) + above[cone.here + y];
    let beyond_high =
        through(high, light_above(cone.behind, cone.there + length, y + 2, cone.rows)) + above[cone.here + length + y];
    let received = weighed(cone.weight.x, low, beyond_low) + weighed(cone.weight.y, high, beyond_high);
    receive(x, y, received, cone.behind, is_meant);
}

// Pixels before even columns.
@compute @workgroup_size(BLOCK)
fn receive_even(@builtin(local_invocation_index) local: u32, @builtin(workgroup_id) id: vec3u) {
    let lane = i32(local);
    let q = i32(id.x) + 1; // of level 1
    let word = i32(id.y);
    let x = 2 * q - 1;
    let length = quadrant.length;
    let cone = cone_of(q, 0.5);
    let found = near_of(x + 1, word, 1);
    let clear = blocks_in(word) & ~found;

    var left = some_of(clear);
    loop {
        receive_even_at(cone, length, x, row_in(word, left, lane), nothing(), nothing(), clear != 0u);
        continuing {
            left &= left - 1u;
            break if left == 0u;
        }
    }
    left = some_of(found);
    loop {
        let y = row_in(word, left, lane);
        receive_even_at(cone, length, x, y, cross(x + 1, y, 2, -2), cross(x + 1, y, 2, 2), found != 0u);
        count(2, select(0u, 2u, (found != 0u) & (y < length)));
        continuing {
            left &= left - 1u;
            break if left == 0u;
        }
    }
}
