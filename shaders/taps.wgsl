// Segments of holographic radiance cascades through the pixels of the world, one pixel behind the other
// (src/holographic/strip.c): both ends count half; what passes through corners is the mean of two ways, one on either
// side of them.

const STRAIGHT: u32 = 0u;
const SLANTED: u32 = 1u; // one across for two along
const DIAGONAL: u32 = 2u;
const POINT: u32 = 3u;

@group(0) @binding(3) var<storage, read_write> counters: array<atomic<u32>>; // segments, by level
@group(0) @binding(9) var<storage, read> near: array<u32>; // as near.wgsl leaves it

// No && in this file: it is a branch, and dozens of them take a software adapter minutes to compile.

fn is_inside(x: i32, y: i32) -> bool {
    return (x < quadrant.width) & (u32(y) < u32(quadrant.length));
}

fn pixel_at(x: i32, y: i32) -> i32 {
    return world_column(x) * quadrant.pixel_x + y * quadrant.pixel_y;
}

fn near_word(x: i32, word: i32, level: i32) -> u32 {
    let found = near[(x * quadrant.words + word) * 4 + level];
    return select(0u, found, (x < quadrant.width) & (word < quadrant.words));
}

// The blocks of a column from which a segment of a level may meet anything.
fn near_of(x: i32, first: i32, level: i32) -> Window {
    let word = first >> 5u;
    return Window(near_word(x, word, level), near_word(x, word + 1, level));
}

fn count(reach: i32, segments: u32) {
    atomicAdd(&counters[firstTrailingBit(reach)], segments);
}

// Through the corner between (x, y-1), entered along the axis, and (x-1, y), entered across it: by one of the two.
fn corner(before: Trail, x: i32, y: i32, up: i32, other: bool) -> Trail {
    let beside = select(vec2i(x, y - up), vec2i(x - 1, y), other);
    return half(before, beside.x, beside.y, POINT);
}

fn cross_straight(x: i32, y: i32, reach: i32) -> Interval {
    var v = half(fresh(), x, y, STRAIGHT);
    for (var i = 1; i < reach; i++) {
        v = full(v, x + i, y, STRAIGHT);
    }
    return segment_of(half(v, x + reach, y, STRAIGHT));
}

// On one side of all corners.
fn cross_beside(x: i32, y: i32, reach: i32, up: i32, other: bool) -> Interval {
    var v = half(fresh(), x, y, DIAGONAL);
    for (var i = 1; i < reach; i++) {
        v = full(corner(v, x + i, y + up * i, up, other), x + i, y + up * i, DIAGONAL);
    }
    return segment_of(half(corner(v, x + reach, y + up * reach, up, other), x + reach, y + up * reach, DIAGONAL));
}

fn cross_diagonal(x: i32, y: i32, reach: i32, up: i32) -> Interval {
    return mean_of(cross_beside(x, y, reach, up, false), cross_beside(x, y, reach, up, true));
}

// Two across for four along.
fn cross_slanted(x: i32, y: i32, up: i32) -> Interval {
    var v = half(fresh(), x, y, SLANTED);
    v = half(v, x + 1, y, SLANTED);
    v = half(v, x + 1, y + up, SLANTED);
    v = full(v, x + 2, y + up, SLANTED);
    v = half(v, x + 3, y + up, SLANTED);
    v = half(v, x + 3, y + 2 * up, SLANTED);
    return segment_of(half(v, x + 4, y + 2 * up, SLANTED));
}

// Two across for eight along, and six. There are no chords of their slopes: those of the next slopes on either side make
// up their length.
fn cross_low(x: i32, y: i32, up: i32) -> Interval {
    var v = full(half(fresh(), x, y, STRAIGHT), x + 1, y, STRAIGHT);
    v = half(half(v, x + 2, y, SLANTED), x + 2, y + up, SLANTED);
    v = full(v, x + 3, y + up, STRAIGHT);
    v = full(v, x + 4, y + up, STRAIGHT);
    v = full(v, x + 5, y + up, STRAIGHT);
    v = half(half(v, x + 6, y + up, SLANTED), x + 6, y + 2 * up, SLANTED);
    v = full(v, x + 7, y + 2 * up, STRAIGHT);
    return segment_of(half(v, x + 8, y + 2 * up, STRAIGHT));
}

fn cross_high(x: i32, y: i32, up: i32) -> Interval {
    var v = half(half(fresh(), x, y, SLANTED), x + 1, y, SLANTED);
    v = half(half(v, x + 1, y + up, DIAGONAL), x + 2, y + up, DIAGONAL);
    v = half(half(v, x + 2, y + 2 * up, DIAGONAL), x + 3, y + 2 * up, SLANTED);
    v = half(v, x + 3, y + 3 * up, SLANTED);
    v = full(v, x + 4, y + 3 * up, DIAGONAL);
    v = half(half(v, x + 5, y + 3 * up, SLANTED), x + 5, y + 4 * up, SLANTED);
    v = half(half(v, x + 6, y + 4 * up, DIAGONAL), x + 6, y + 5 * up, DIAGONAL);
    v = half(half(v, x + 7, y + 5 * up, DIAGONAL), x + 7, y + 6 * up, SLANTED);
    return segment_of(half(v, x + 8, y + 6 * up, SLANTED));
}

// From (x, y) by (reach, rise), for reaches 2, 4 and 8.
fn cross(x: i32, y: i32, reach: i32, rise: i32) -> Interval {
    let up = select(1, -1, rise < 0);
    if (reach == 8) {
        if (abs(rise) == 2) {
            return cross_low(x, y, up);
        }
        return cross_high(x, y, up);
    }
    if (rise == 0) {
        return cross_straight(x, y, reach);
    }
    if (abs(rise) == reach) {
        return cross_diagonal(x, y, reach, up);
    }
    return cross_slanted(x, y, up);
}
