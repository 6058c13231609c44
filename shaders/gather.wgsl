// What level 0 receives (src/holographic/gather.c): a pixel takes the radiance of the next column, or quadrants would
// share the rays at 45 degrees; what lies between the two centres is in the way. Groups are counted by column.

override ADD: bool = false; // the second quadrant of its axis adds to the first

@group(0) @binding(2) var<storage, read> radiance: array<vec4f>; // R of level 0
@group(0) @binding(3) var<storage, read_write> sums: array<vec4f>; // [column][row], of one axis
@group(0) @binding(4) var<uniform> sky: vec3f;

@compute @workgroup_size(GROUP)
fn receive(@builtin(local_invocation_index) first: u32, @builtin(workgroup_id) id: vec3u) {
    let x = i32(id.x);
    let out = world_column(x) * quadrant.length;
    let next = cone_at(1, x + 1, 0);
    for (var y = i32(first); y < quadrant.length; y += ROW_STEP) {
        var light = select(sky, radiance[next + y].rgb, x + 1 < quadrant.width);
        if (CHORDS > 1u) {
            let step = cross_straight(x, y, 1);
            light = light_of(step) + through(step, light);
        }
        if (ADD) {
            light += sums[out + y].rgb;
        }
        sums[out + y] = vec4f(light, 0.0);
    }
}
