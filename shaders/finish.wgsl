// From the sums of the quadrants to the picture (src/holographic/band.c and finish.c): the mean over four quadrants, a
// cross-shaped filter that takes neighbours by pairs or not at all, another beside lamps (rims.wgsl), and the emission of
// opaque pixels.

struct Picture {
    size: vec2u, // [px]
}

const OPAQUE: f32 = 2.0;

@group(0) @binding(0) var<uniform> picture: Picture;
@group(0) @binding(1) var<storage, read> emission: array<vec4f>; // as layer.wgsl leaves it
@group(0) @binding(2) var sums_along_x: texture_2d<f32>; // [x][y]
@group(0) @binding(3) var sums_along_y: texture_2d<f32>; // [y][x]
@group(0) @binding(4) var<storage, read_write> light: array<f32>; // [pixel][3]

// Light of a pixel, and 1 where it is free; of walls and beyond the world 0 and 0.
fn at(x: i32, y: i32) -> vec4f {
    let size = vec2i(picture.size);
    if (x < 0 || y < 0 || x >= size.x || y >= size.y) {
        return vec4f(0.0);
    }
    let pixel = u32(y * size.x + x);
    if (emission[pixel].w == OPAQUE) {
        return vec4f(0.0);
    }
    let texel_x = texel_of(sums_along_x);
    let texel_y = texel_of(sums_along_y);
    let at_x = vec2f(middle_of(y, texel_x.x), middle_of(x, texel_x.y));
    let at_y = vec2f(middle_of(x, texel_y.x), middle_of(y, texel_y.y));
    let along_x = textureSampleLevel(sums_along_x, nearest, at_x, 0.0).rgb;
    let along_y = textureSampleLevel(sums_along_y, nearest, at_y, 0.0).rgb;
    return vec4f(0.25 * along_x + 0.25 * along_y, 1.0);
}

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
        let x = i32(pixel) - y * i32(picture.size.x);
        if (is_on_rim(x, y)) {
            shown = filter_rim(x, y);
        } else {
            shown = filter_cross(x, y);
        }
    }
    light[3u * pixel] = shown.r;
    light[3u * pixel + 1u] = shown.g;
    light[3u * pixel + 2u] = shown.b;
}
