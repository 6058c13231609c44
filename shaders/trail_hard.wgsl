// What a segment has met so far, where a pixel lets through all or nothing: the first opaque one. Only its light is
// loaded. trail_media.wgsl is the same with media; a kernel is built with one of them.

alias Trail = i32; // cell, or NONE

const NONE: i32 = -1;

fn fresh() -> Trail {
    return NONE;
}

fn half(before: Trail, x: i32, y: i32, chord: u32) -> Trail {
    let at = cell_at(x, y);
    let is_opaque = clearance[pixel_at(x, y)] < 0.0;
    return select(before, at, is_opaque & is_inside(x, y) & (before == NONE)); // no &&, as in taps.wgsl
}

fn full(before: Trail, x: i32, y: i32, chord: u32) -> Trail {
    return half(before, x, y, chord);
}

fn segment_of(trail: Trail) -> Interval {
    return choose(nothing(), cells[max(trail, 0)], trail != NONE);
}
