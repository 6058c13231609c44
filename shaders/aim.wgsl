// Where probes stand and how far they are from their parents (src/cascade/aim.h).

// The share of the upper one of two parents, for the lower and the upper one of the two probes between them.
const LOWER_SHARE: f32 = 0.25;
const UPPER_SHARE: f32 = 0.75;

fn probe_position(probe: vec2i, spacing: f32) -> vec2f {
    return (vec2f(probe) + 0.5) * spacing;
}
