// What level 0 receives (src/holographic/gather.c): a pixel takes the radiance of the next column, or quadrants would
// share the rays at 45 degrees; what lies between the two centres is in the way. An item is a row, groups are counted
// by column in z.

override ADD: bool = false; // the second quadrant of its axis adds to the first

@group(0) @binding(2) var<storage, read> radiance: array<vec4f>; // R of level 0
@group(0) @binding(3) var<storage, read_write> sums: array<vec4f>; // [column][row], of one axis
@group(0) @binding(4) var<uniform> sky: vec3f;

@compute @workgroup_size(GROUP)
fn receive(@builtin(global_invocation_id) id: vec3u) {
    let y = i32(id.x);
    if (y >= quadrant.length) {
        return;
    }
    let x = i32(id.z);
    var light = sky;
    if (x + 1 < quadrant.width) {
        light = radiance[cone_at(1, x + 1, 0) + y].rgb;
    }
    if (CHORDS > 1u) {
        let step = cross_straight(x, y, 1);
        light = light_of(step) + through(step, light);
    }
    let at = u32(world_column(x) * quadrant.length + y);
    if (ADD) {
        light += sums[at].rgb;
    }
    sums[at] = vec4f(light, 0.0);
}
