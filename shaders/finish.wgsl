// From the sums of the quadrants to the picture (src/holographic/band.c and finish.c): a cross-shaped filter that takes
// neighbours by pairs or not at all, and the emission of opaque pixels. rims.wgsl has the last word beside lamps.

// Rows that an invocation goes through: what is below one row is beside the next.
const ROWS: i32 = 8;

fn filter_cross(above: vec4f, left: vec4f, here: vec4f, right: vec4f, below: vec4f) -> vec3f {
    let across = above.w * below.w;
    let along = left.w * right.w;
    let sum = 4.0 * here.rgb + across * (above.rgb + below.rgb) + along * (left.rgb + right.rgb);
    return sum / (4.0 + 2.0 * across + 2.0 * along);
}

// An item is a column of so many rows.
@compute @workgroup_size(GROUP)
fn show(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u,
        @builtin(local_invocation_index) local: u32) {
    let size = vec2i(picture.size);
    let item = i32(item_of(group, groups, local));
    let strip = item / size.x;
    let x = item - strip * size.x;
    var y = strip * ROWS;
    if (y >= size.y) {
        return;
    }
    var above = at(x, y - 1);
    var here = at(x, y);
    loop {
        let below = at(x, y + 1);
        let filtered = filter_cross(above, at(x - 1, y), here, at(x + 1, y), below);
        let pixel = u32(y * size.x + x);
        let shown = emission[pixel];
        keep(pixel, select(filtered, shown.rgb, shown.w == OPAQUE));
        above = here;
        here = below;
        continuing {
            y++;
            break if y == min(strip * ROWS + ROWS, size.y);
        }
    }
}
