// One ray through the pixel world: exact traversal that jumps over what the clearance proves empty. Operation for
// operation march() of src/kernel/ref.c. Part of level.wgsl and choose.wgsl, which bind the grid.

const JUMP_FROM: f32 = 2.0; // less, and a step to the next pixel edge gets as far
const TWO_HALF_DIAGONALS: f32 = 1.41421368;
const NEVER: f32 = 1e30; // stands for 1/0

override MEDIA: bool = false; // some pixel is a medium

@group(0) @binding(1) var<storage, read> clearance: array<f32>; // [pixel]: > 0 empty, 0 medium, < 0 opaque
@group(0) @binding(2) var<storage, read> emission: array<vec4f>; // [pixel]
@group(0) @binding(3) var<storage, read> extinction: array<vec4f>; // [pixel]; read where the clearance is 0

struct Ray {
    start: vec2f,
    direction: vec2f,
    inverse: vec2f,
    reach: f32,
    step: vec2i, // -1 or 1
    side: vec2i, // which edge of a pixel it leaves by: 0 or 1
}

// What a ray gathers: light, and the share that passes what lies behind.
struct Interval {
    radiance: vec3f,
    passed: vec3f,
}

fn inverse_or_never(d: f32) -> f32 {
    if (d != 0.0) {
        return 1.0 / d;
    }
    return NEVER;
}

fn ray_between(start: vec2f, end: vec2f) -> Ray {
    var ray: Ray;
    let d = end - start;
    ray.start = start;
    ray.reach = sqrt(d.x * d.x + d.y * d.y);
    ray.direction = d * inverse_or_never(ray.reach);
    ray.inverse = vec2f(inverse_or_never(ray.direction.x), inverse_or_never(ray.direction.y));
    let back = ray.direction < vec2f(0.0);
    ray.step = select(vec2i(1), vec2i(-1), back);
    ray.side = select(vec2i(1), vec2i(0), back);
    return ray;
}

// Along one axis: where a ray enters [0, size].
fn enter_axis(start: f32, direction: f32, inverse: f32, size: f32) -> f32 {
    if (start < 0.0) {
        return select(NEVER, -start * inverse, direction > 0.0);
    }
    if (start > size) {
        return select(NEVER, (size - start) * inverse, direction < 0.0);
    }
    return 0.0;
}

fn cross_medium(gathered: Interval, cell: u32, stretch: f32) -> Interval {
    let thickness = extinction[cell].rgb * stretch;
    let through = vec3f(exp_negative(thickness.r), exp_negative(thickness.g), exp_negative(thickness.b));
    return Interval(gathered.radiance + gathered.passed * (emission[cell].rgb * (1.0 - through)),
                    gathered.passed * through);
}

fn hit_opaque(gathered: Interval, cell: u32) -> Interval {
    return Interval(gathered.radiance + gathered.passed * emission[cell].rgb, vec3f(0.0));
}

fn march(start: vec2f, end: vec2f, picture: vec2u) -> Interval {
    let ray = ray_between(start, end);
    let size = vec2f(picture);
    let bounds = vec2i(picture);
    var gathered = Interval(vec3f(0.0), vec3f(1.0));
    var t = max(enter_axis(start.x, ray.direction.x, ray.inverse.x, size.x),
                enter_axis(start.y, ray.direction.y, ray.inverse.y, size.y));
    if (!(t < ray.reach)) {
        return gathered;
    }
    let entry = start + t * ray.direction;
    var at = vec2i(floor(entry));
    if (t > 0.0) {
        if (any(entry < vec2f(-1.0)) || any(entry > size + 1.0)) {
            return gathered; // passes by a corner
        }
        at = clamp(at, vec2i(0), bounds - 1);
    }
    while (at.x >= 0 && at.y >= 0 && at.x < bounds.x && at.y < bounds.y) {
        let cell = u32(at.y * bounds.x + at.x);
        let free = clearance[cell];
        if (free >= JUMP_FROM) {
            t += free - TWO_HALF_DIAGONALS;
            if (t >= ray.reach) {
                return gathered;
            }
            at = vec2i(floor(start + t * ray.direction));
            continue;
        }
        if (free < 0.0) {
            return hit_opaque(gathered, cell);
        }
        let edge = (vec2f(at + ray.side) - start) * ray.inverse;
        let leave = min(edge.x, edge.y);
        if (MEDIA) {
            let until = min(leave, ray.reach);
            if (free == 0.0 && until > t) {
                gathered = cross_medium(gathered, cell, until - t);
            }
        }
        if (leave >= ray.reach) {
            return gathered;
        }
        t = leave;
        if (edge.x <= edge.y) { // an exact corner looks at the neighbour in x first
            at.x += ray.step.x;
        } else {
            at.y += ray.step.y;
        }
    }
    return gathered;
}
