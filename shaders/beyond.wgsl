// What merges of holographic radiance cascades read of the level above and how they weigh it. Part of merge.wgsl and
// gather.wgsl.

@group(0) @binding(5) var above: texture_2d<f32>; // R of the level above: [column][cone][row]
@group(0) @binding(6) var<storage, read> weights: array<vec2f>; // cone i of level n at 2^n + i: shares of its two cones
@group(0) @binding(7) var<uniform> sky: vec3f;

// A column of the level above, from one of its cones on.
struct Column {
    low: f32, // place of that cone
    high: f32, // and of the next
    texel: f32, // from a row to the next
    rows: u32, // none in a column beyond the world
    sky: vec3f,
}

fn column_of(reach: i32, p: i32, i: i32) -> Column {
    let texel = texel_of(above);
    let low = middle_of(cone_row_of(reach, p, i), texel.y);
    let rows = u32(select(0, quadrant.length, p < quadrant.columns_above));
    return Column(low, low + texel.y, texel.x, rows, sky);
}

// R of a cone of the level above in a row of the world.
fn light_at(column: Column, cone: f32, y: i32) -> vec3f {
    return textureSampleLevel(above, nearest, vec2f(middle_of(y, column.texel), cone), 0.0).rgb;
}

// The same; beyond the world there is the sky.
fn light_beyond(column: Column, cone: f32, y: i32) -> vec3f {
    return select(column.sky, light_at(column, cone, y), u32(y) < column.rows);
}

// What a ray brings: its own light and, behind it, `beyond`.
fn weighed(weight: f32, seen: Interval, beyond: vec3f) -> vec3f {
    return weight * light_of(seen) + weight * beyond;
}
