// Where probes stand and which parents they lie between, one axis at a time (src/cascade/aim.h).

// The lower one of the two parents.
fn lower_parent(probe: i32) -> i32 {
    return probe / 2 - select(0, 1, (probe & 1) == 0);
}

// The share of the upper one.
fn upper_share(probe: i32) -> f32 {
    return select(0.25, 0.75, (probe & 1) == 0);
}

fn probe_position(probe: vec2i, spacing: f32) -> vec2f {
    return (vec2f(probe) + 0.5) * spacing;
}
