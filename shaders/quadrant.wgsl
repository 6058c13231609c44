// One quadrant of holographic radiance cascades at one level: what strip.wgsl, column.wgsl and gather.wgsl are told.
// Coordinates are those of the quadrant: x along the way it gathers, y across.

struct Quadrant {
    width: i32, // along the gather axis [px]
    length: i32, // across it [px]
    level: u32,
    mirrored: u32, // 1: x counts from the far end
    first: u32, // column of the first item
    stride: u32, // from an item's column to the next
}

@group(0) @binding(0) var<uniform> quadrant: Quadrant;

// Columns of a level.
fn columns_of(level: u32) -> i32 {
    return (quadrant.width + (1 << level) - 1) >> level;
}

// A column of the quadrant as the world counts it.
fn world_column(x: i32) -> i32 {
    return select(x, quadrant.width - 1 - x, quadrant.mirrored != 0u);
}

// T of ray k of column p at row y, in a level's buffer.
fn segment_at(level: u32, p: i32, k: i32, y: i32) -> u32 {
    return u32((p * ((1 << level) + 1) + k) * quadrant.length + y);
}

// R of cone i of column p at row y.
fn cone_at(level: u32, p: i32, i: i32, y: i32) -> u32 {
    return u32(((p << level) + i) * quadrant.length + y);
}
