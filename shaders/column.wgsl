// The two steps that holographic radiance cascades are made of (src/holographic/column.c): segments of twice the
// length, and radiance merged from the level above. An item is a row; groups are counted by ray or cone, and column.
//
// Everything is loaded from where it would be, and replaced where that is outside the world: a software adapter
// computes both sides of a branch anyway.

override TOP: bool = false; // above the merged level there is only the sky

@group(0) @binding(1) var<storage, read> own: array<Interval>; // T of the quadrant's level
@group(0) @binding(2) var<storage, read_write> longer: array<Interval>; // extend: T of the level above
@group(0) @binding(3) var<storage, read> across: array<Interval>; // merge: the same
@group(0) @binding(4) var<storage, read> above: array<f32>; // R of the level above: [column][cone][row][3]
@group(0) @binding(5) var<storage, read_write> radiance: array<f32>; // R of the quadrant's level
@group(0) @binding(6) var<storage, read> weights: array<f32>; // cone i of level n at 2^n + i: its share of its parent
@group(0) @binding(7) var<uniform> sky: vec3f;

// T of a ray of an odd column; beyond the world there is nothing.
fn far_segment(p: i32, k: i32, y: i32) -> Interval {
    let inside = p < quadrant.columns && u32(y) < u32(quadrant.length);
    return choose(nothing(), own[segment_at(quadrant.reach, p, k, y)], inside);
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
    let rise = 2 * k - quadrant.reach;
    let near = own[segment_at(quadrant.reach, 2 * p, k, y)];
    let out = segment_at(2 * quadrant.reach, p, 2 * k, y);
    longer[out] = compose(near, far_segment(2 * p + 1, k, y + rise));
    let low = compose(near, far_segment(2 * p + 1, k + 1, y + rise));
    let next = own[segment_at(quadrant.reach, 2 * p, k + 1, y)];
    let high = compose(next, far_segment(2 * p + 1, k, y + rise + 2));
    if (k < quadrant.reach) {
        longer[out + u32(quadrant.length)] = mean_of(low, high);
    }
}

// R of the level above; beyond the world there is the sky.
fn light_above(p: i32, cone: i32, y: i32) -> vec3f {
    if (TOP) {
        return sky;
    }
    let inside = p < quadrant.columns_above && u32(y) < u32(quadrant.length);
    let at = 3u * cone_at(2 * quadrant.reach, p, cone, y);
    return select(sky, vec3f(above[at], above[at + 1u], above[at + 2u]), inside);
}

fn store(cone: u32, light: vec3f) {
    radiance[3u * cone] = light.r;
    radiance[3u * cone + 1u] = light.g;
    radiance[3u * cone + 2u] = light.b;
}

// What a ray brings: its own light and, behind it, `beyond`.
fn weighed(weight: f32, seen: Interval, beyond: vec3f) -> vec3f {
    return weight * light_of(seen) + weight * beyond;
}

// A cone of an odd column: what its two rays bring, and behind them the next column of the level above.
@compute @workgroup_size(GROUP)
fn merge_odd(@builtin(global_invocation_id) id: vec3u) {
    let y = i32(id.x);
    if (y >= quadrant.length) {
        return;
    }
    let i = i32(id.y);
    let q = i32(id.z); // column of the level above that begins here
    let rise = 2 * i - quadrant.reach;
    let low = own[segment_at(quadrant.reach, 2 * q + 1, i, y)];
    let high = own[segment_at(quadrant.reach, 2 * q + 1, i + 1, y)];
    let beyond_low = through(low, light_above(q + 1, 2 * i, y + rise));
    let beyond_high = through(high, light_above(q + 1, 2 * i + 1, y + rise + 2));
    let weight = 2 * (quadrant.reach + i);
    store(cone_at(quadrant.reach, 2 * q + 1, i, y),
          weighed(weights[weight], low, beyond_low) + weighed(weights[weight + 1], high, beyond_high));
}

// A cone of an even column, which the level above has too: half of it from here, half from the end of its segments.
@compute @workgroup_size(GROUP)
fn merge_even(@builtin(global_invocation_id) id: vec3u) {
    let y = i32(id.x);
    if (y >= quadrant.length) {
        return;
    }
    let i = i32(id.y);
    let q = i32(id.z) + 1; // of the level above
    let rise = 2 * (2 * i - quadrant.reach);
    let low = across[segment_at(2 * quadrant.reach, q, 2 * i, y)];
    let high = across[segment_at(2 * quadrant.reach, q, 2 * i + 2, y)];
    let beyond_low = through(low, light_above(q + 1, 2 * i, y + rise)) + light_above(q, 2 * i, y);
    let beyond_high = through(high, light_above(q + 1, 2 * i + 1, y + rise + 4)) + light_above(q, 2 * i + 1, y);
    let weight = 2 * (quadrant.reach + i);
    store(cone_at(quadrant.reach, 2 * q, i, y),
          weighed(0.5 * weights[weight], low, beyond_low) + weighed(0.5 * weights[weight + 1], high, beyond_high));
}
