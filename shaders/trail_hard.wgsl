// What a segment has met so far, where a pixel lets through all or nothing: the first opaque one. Only its light is
// loaded. trail_media.wgsl is the same with media; a kernel is built with one of them.

@group(0) @binding(1) var<storage, read> emission: array<vec4f>; // RGB, and what the pixel is: web/webgpu/world.js

alias Trail = i32; // pixel, or NONE

const NONE: i32 = -1;
const OPAQUE: f32 = 2.0;
const RADIANCE_MAX: f32 = 1e37;

fn fresh() -> Trail {
    return NONE;
}

fn half(before: Trail, x: i32, y: i32, chord: u32) -> Trail {
    let at = pixel_at(x, y);
    let is_opaque = emission[at].w == OPAQUE;
    return select(before, at, is_opaque & is_inside(x, y) & (before == NONE)); // no &&, as in taps.wgsl
}

fn full(before: Trail, x: i32, y: i32, chord: u32) -> Trail {
    return half(before, x, y, chord);
}

fn segment_of(trail: Trail) -> Interval {
    let light = min(emission[max(trail, 0)].rgb, vec3f(RADIANCE_MAX));
    return choose(nothing(), interval_of(light, vec3f(0.0)), trail != NONE);
}
