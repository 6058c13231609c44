// What a segment has met so far, where there are media: half a chord of each pixel. trail_hard.wgsl is the same
// without media; a kernel is built with one of them.

const CHORDS: i32 = 4; // as in world.wgsl

@group(0) @binding(1) var<storage, read> cells: array<Interval>; // [column][row][chord], of one axis

alias Trail = Interval;

fn fresh() -> Trail {
    return nothing();
}

// Outside the world there is nothing.
fn half_chord(x: i32, y: i32, chord: u32) -> Interval {
    return choose(nothing(), cells[(world_column(x) * quadrant.length + y) * CHORDS + i32(chord)], is_inside(x, y));
}

fn half(before: Trail, x: i32, y: i32, chord: u32) -> Trail {
    return compose(before, half_chord(x, y, chord));
}

fn full(before: Trail, x: i32, y: i32, chord: u32) -> Trail {
    let pixel = half_chord(x, y, chord);
    return compose(compose(before, pixel), pixel);
}

fn segment_of(trail: Trail) -> Interval {
    return trail;
}
