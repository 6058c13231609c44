// From the sums of the quadrants to the picture (src/holographic/band.c and finish.c): a cross-shaped filter that takes
// neighbours by pairs or not at all, and the emission of opaque pixels. rims.wgsl has the last word beside lamps.

fn filter_cross(x: i32, y: i32) -> vec3f {
    let above = at(x, y - 1);
    let below = at(x, y + 1);
    let left = at(x - 1, y);
    let right = at(x + 1, y);
    let across = above.w * below.w;
    let along = left.w * right.w;
    let sum = 4.0 * at(x, y).rgb + across * (above.rgb + below.rgb) + along * (left.rgb + right.rgb);
    return sum / (4.0 + 2.0 * across + 2.0 * along);
}

@compute @workgroup_size(GROUP)
fn show(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u,
        @builtin(local_invocation_index) local: u32) {
    let pixel = item_of(group, groups, local);
    if (pixel >= picture.size.x * picture.size.y) {
        return;
    }
    var shown = emission[pixel].rgb;
    if (emission[pixel].w != OPAQUE) {
        let y = i32(pixel / picture.size.x);
        shown = filter_cross(i32(pixel) - y * i32(picture.size.x), y);
    }
    keep(pixel, shown);
}
