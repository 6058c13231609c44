// What merges of holographic radiance cascades read of the level above and how they weigh it. Part of merge.wgsl and
// gather.wgsl.

@group(0) @binding(5) var<storage, read> above: array<vec3f>; // R of the level above: [column][cone][row]
@group(0) @binding(6) var<storage, read> weights: array<vec2f>; // cone i of level n at 2^n + i: shares of its two cones
@group(0) @binding(7) var<uniform> sky: vec3f;

// A column of the level above, from one of its cones on.
struct Beyond {
    at: i32, // where row 0 of that is
    rows: u32, // none in a column beyond the world
    sky: vec3f,
}

fn beyond_of(reach: i32, p: i32, i: i32) -> Beyond {
    return Beyond(cone_at(reach, p, i), u32(select(0, quadrant.length, p < quadrant.columns_above)), sky);
}

// R of row y of a cone that is this far behind the first; beyond the world there is the sky.
fn light_beyond(beyond: Beyond, cone: i32, y: i32) -> vec3f {
    return select(beyond.sky, above[beyond.at + cone + y], u32(y) < beyond.rows);
}

// What a ray brings: its own light and, behind it, `beyond`.
fn weighed(weight: f32, seen: Interval, beyond: vec3f) -> vec3f {
    return weight * light_of(seen) + weight * beyond;
}
