// From R of level 1 to what pixels receive (src/holographic/gather.c): level 0 is traced as it is needed. A pixel takes
// the radiance of the next column, or quadrants would share the rays at 45 degrees; what lies between the two centres
// is in the way. Groups are counted by column.

override MEDIA: bool = false; // some pixel is a medium
override ADD: bool = false; // the second quadrant of its axis adds to the first

@group(0) @binding(4) var<storage, read_write> sums: array<vec3f>; // [column][row], of one axis

// The two rays of a cone as wide as the quadrant.
struct Rays {
    low: Interval,
    high: Interval,
}

fn trace_rays(x: i32, y: i32, reach: i32) -> Rays {
    var rays = Rays(nothing(), nothing());
    for (var traced = is_near(x, y, reach); traced; traced = false) { // a branch, as in strip.wgsl
        rays = Rays(cross(x, y, reach, -reach), cross(x, y, reach, reach));
        count(reach, 2u);
    }
    return rays;
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
        let rays = trace_rays(2 * q + 1, y, 1);
        let beyond_low = through(rays.low, light_above(there, y - 1, rows));
        let beyond_high = through(rays.high, light_above(there + quadrant.length, y + 1, rows));
        receive(2 * q, y, weighed(weight.x, rays.low, beyond_low) + weighed(weight.y, rays.high, beyond_high));
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
        let rays = trace_rays(2 * q, y, 2);
        let beyond_low = through(rays.low, light_above(there, y - 2, rows)) + above[here + y];
        let beyond_high = through(rays.high, light_above(there + quadrant.length, y + 2, rows)) +
                          above[here + quadrant.length + y];
        receive(2 * q - 1, y, weighed(weight.x, rays.low, beyond_low) + weighed(weight.y, rays.high, beyond_high));
    }
}
