// From the sums of the quadrants to the picture (src/holographic/band.c and finish.c): the mean over four quadrants, a
// cross-shaped filter that takes neighbours by pairs or not at all, another beside lamps, and the emission of
// opaque pixels.

@group(0) @binding(2) var sums_along_x: texture_2d<f32>; // [x][y]
@group(0) @binding(3) var sums_along_y: texture_2d<f32>; // [y][x]
@group(0) @binding(4) var<storage, read_write> light: array<f32>; // [pixel][3]
@group(0) @binding(7) var<storage, read> near: array<vec4f>; // as rims.wgsl leaves it

// Light of a pixel, and 1 where it is free; of walls and beyond the world 0 and 0.
fn at(x: i32, y: i32) -> vec4f {
    if (!is_free(x, y)) {
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

// What a pixel and its neighbours add up to.
struct Total {
    light: vec3f,
    near: vec3f,
    open: f32, // share of directions in which there is no lamp near
}

fn add(total: ptr<function, Total>, x: i32, y: i32, weight: f32) {
    let here = near[y * i32(picture.size.x) + x];
    (*total).light += weight * at(x, y).rgb;
    (*total).near += weight * here.rgb;
    (*total).open += weight * (1.0 - here.w);
}

// Walls that touch at a corner let nothing through: between two of them no neighbour is reached.
fn is_reached(x: i32, y: i32, dx: i32, dy: i32) -> bool {
    return is_free(x + dx, y + dy) && (is_free(x + dx, y) || is_free(x, y + dy));
}

// Two neighbours opposite each other.
fn add_pair(total: ptr<function, Total>, x: i32, y: i32, dx: i32, dy: i32, weight: f32) {
    if (!is_reached(x, y, dx, dy) || !is_reached(x, y, -dx, -dy)) {
        return;
    }
    add(total, x + dx, y + dy, weight);
    add(total, x - dx, y - dy, weight);
}

// What comes from further away comes through what is open. Where there is less light than from near, there is a medium
// in between: what is left of it falls off all the same.
fn filter_rim(x: i32, y: i32) -> vec3f {
    let here = near[y * i32(picture.size.x) + x];
    var total = Total(vec3f(0.0), vec3f(0.0), 0.0);
    add(&total, x, y, 4.0);
    add_pair(&total, x, y, 1, 0, 2.0);
    add_pair(&total, x, y, 0, 1, 2.0);
    add_pair(&total, x, y, 1, 1, 1.0);
    add_pair(&total, x, y, 1, -1, 1.0);
    let further = (total.light - total.near) * select(0.0, (1.0 - here.w) / total.open, total.open > 0.0);
    let left = total.light / max(total.near, vec3f(1e-37));
    return select(here.rgb + further, here.rgb * left, total.light < total.near);
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
        if (is_beside_lamps(x, y, RIM)) {
            shown = filter_rim(x, y);
        } else {
            shown = filter_cross(x, y);
        }
    }
    light[3u * pixel] = shown.r;
    light[3u * pixel + 1u] = shown.g;
    light[3u * pixel + 2u] = shown.b;
}
