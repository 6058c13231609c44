// What merges of holographic radiance cascades read and how they weigh it. Part of column.wgsl and gather.wgsl.

@group(0) @binding(5) var<storage, read> above: array<vec3f>; // R of the level above: [column][cone][row]
@group(0) @binding(6) var<storage, read> weights: array<vec2f>; // cone i of level n at 2^n + i: shares of its two cones
@group(0) @binding(7) var<uniform> sky: vec3f;

// Rows that a segment or cone may be asked for, from the first: none in a column beyond the world.
fn rows_of(p: i32, columns: i32) -> u32 {
    return u32(select(0, quadrant.length, p < columns));
}

// R of the level above; beyond the world there is what lies behind it.
fn light_above(behind: vec3f, cone: i32, y: i32, rows: u32) -> vec3f {
    return select(behind, above[cone + y], u32(y) < rows);
}

// What a ray brings: its own light and, behind it, `beyond`.
fn weighed(weight: f32, seen: Interval, beyond: vec3f) -> vec3f {
    return weight * light_of(seen) + weight * beyond;
}
