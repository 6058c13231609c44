// The two steps that holographic radiance cascades are made of (src/holographic/column.c): segments of twice the
// length, and radiance merged from the level above. An item is a row; groups are counted by ray or cone, and column.

override TOP: bool = false; // above the merged level there is only the sky

@group(0) @binding(1) var<storage, read> own: array<Interval>; // T of the quadrant's level
@group(0) @binding(2) var<storage, read_write> longer: array<Interval>; // extend: T of the level above
@group(0) @binding(3) var<storage, read> across: array<Interval>; // merge: the same
@group(0) @binding(4) var<storage, read> above: array<vec4f>; // R of the level above
@group(0) @binding(5) var<storage, read_write> radiance: array<vec4f>; // R of the quadrant's level
@group(0) @binding(6) var<storage, read> weights: array<f32>; // cone i of level n at 2^n + i: its share of its parent
@group(0) @binding(7) var<uniform> sky: vec3f;

// T of a ray that starts in column p; beyond the world there is nothing.
fn segment(p: i32, k: i32, y: i32) -> Interval {
    if (p >= columns_of(quadrant.level) || y < 0 || y >= quadrant.length) {
        return nothing();
    }
    return own[segment_at(quadrant.level, p, k, y)];
}

// Rays 2k and 2k+1 of the level above from rays k and k+1, which are half as long.
@compute @workgroup_size(GROUP)
fn extend(@builtin(global_invocation_id) id: vec3u) {
    let y = i32(id.x);
    if (y >= quadrant.length) {
        return;
    }
    let k = i32(id.y);
    let p = i32(id.z) + 1;
    let reach = 1 << quadrant.level;
    let rise = 2 * k - reach;
    let near = own[segment_at(quadrant.level, 2 * p, k, y)];
    let far = segment(2 * p + 1, k, y + rise);
    longer[segment_at(quadrant.level + 1u, p, 2 * k, y)] = compose(near, far);
    if (k == reach) {
        return;
    }
    let low = compose(near, segment(2 * p + 1, k + 1, y + rise));
    let high = compose(own[segment_at(quadrant.level, 2 * p, k + 1, y)], segment(2 * p + 1, k, y + rise + 2));
    longer[segment_at(quadrant.level + 1u, p, 2 * k + 1, y)] = mean_of(low, high);
}

// R of the level above; beyond the world there is the sky.
fn light_above(p: i32, cone: i32, y: i32) -> vec3f {
    if (TOP || p >= columns_of(quadrant.level + 1u) || y < 0 || y >= quadrant.length) {
        return sky;
    }
    return above[cone_at(quadrant.level + 1u, p, cone, y)].rgb;
}

// A cone of an odd column: what its two rays bring, and behind them the next column of the level above.
fn merge_odd(p: i32, i: i32, y: i32) -> vec3f {
    let reach = 1 << quadrant.level;
    var sum = vec3f(0.0);
    for (var s = 0; s < 2; s++) {
        let k = i + s;
        let cone = 2 * i + s;
        let seen = own[segment_at(quadrant.level, p, k, y)];
        let beyond = through(seen, light_above((p >> 1u) + 1, cone, y + 2 * k - reach));
        let weight = weights[2 * reach + cone];
        sum += weight * light_of(seen) + weight * beyond;
    }
    return sum;
}

// A cone of an even column, which the level above has too: half of it from here, half from the end of its segments.
fn merge_even(p: i32, i: i32, y: i32) -> vec3f {
    let reach = 1 << quadrant.level;
    var sum = vec3f(0.0);
    for (var s = 0; s < 2; s++) {
        let k = i + s;
        let cone = 2 * i + s;
        let seen = across[segment_at(quadrant.level + 1u, p >> 1u, 2 * k, y)];
        let far = light_above((p >> 1u) + 1, cone, y + 2 * (2 * k - reach));
        let beyond = through(seen, far) + light_above(p >> 1u, cone, y);
        let weight = 0.5 * weights[2 * reach + cone];
        sum += weight * light_of(seen) + weight * beyond;
    }
    return sum;
}

@compute @workgroup_size(GROUP)
fn merge(@builtin(global_invocation_id) id: vec3u) {
    let y = i32(id.x);
    if (y >= quadrant.length) {
        return;
    }
    let i = i32(id.y);
    let p = i32(id.z) + 1;
    var light = vec3f(0.0);
    if (TOP || (p & 1) != 0) { // the top level has no even column
        light = merge_odd(p, i, y);
    } else {
        light = merge_even(p, i, y);
    }
    radiance[cone_at(quadrant.level, p, i, y)] = vec4f(light, 0.0);
}
