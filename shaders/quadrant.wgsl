// One quadrant of holographic radiance cascades at one level: what strip.wgsl, column.wgsl and gather.wgsl are told.
// Coordinates are those of the quadrant: x along the way it gathers, y across.

struct Quadrant {
    width: i32, // along the gather axis [px]
    length: i32, // across it [px]
    reach: i32, // 2^level: along the axis, of a segment [px]
    columns: i32, // of the level
    columns_above: i32, // of the level above
    mirrored: i32, // 1: x counts from the far end
    first: i32, // column of the first item
    stride: i32, // from an item's column to the next
    pixel_x: i32, // from a pixel of the world to the next, along
    pixel_y: i32, // and across
    words: i32, // of the blocks of a row
    rows: i32, // rows of all levels below, as `blocks` counts them
    rows_above: i32, // and of the level
    rows_between: i32, // of all levels: behind them come those of straight rays of level 3
}

@group(0) @binding(0) var<uniform> quadrant: Quadrant;

// A group goes through a row block by block. Of a block an invocation has every other value, for from level 1 on
// segments rise by even numbers: what one value's ray ends at, the next one's may end at, too.
override LANES: u32 = 16u; // invocations of a group: 1 to 16, a power of two
const BLOCK: i32 = 16;
override ROWS: i32 = BLOCK / i32(LANES); // of an invocation
const ROW_STEP: i32 = 2;

fn first_row(lane: u32) -> i32 {
    return i32(lane & 1u) + i32(lane >> 1u) * ROWS * ROW_STEP;
}

// A column of the quadrant as the world counts it.
fn world_column(x: i32) -> i32 {
    return select(x, quadrant.width - 1 - x, quadrant.mirrored != 0);
}

// Where a row is kept; all that are not wanted, before the first row or behind the last one, in one that nobody reads.
fn kept_at(y: i32, is_wanted: bool) -> i32 {
    let length = u32(quadrant.length);
    return i32(select(length, min(u32(y), length), is_wanted));
}

// T of ray k of column p: its row in a level whose segments reach that far.
fn row_of(reach: i32, p: i32, k: i32) -> i32 {
    return p * (reach + 1) + k;
}

// Straight rays of level 3 in between, of which a column has four.
fn between_row_of(p: i32, k: i32) -> i32 {
    return 4 * p + k;
}

// R of cone i of column p: its row.
fn cone_row_of(reach: i32, p: i32, i: i32) -> i32 {
    return p * reach + i;
}
