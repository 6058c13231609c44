// One ray through the pixel world: exact traversal that jumps over what the clearance proves empty. Operation for
// operation march() of src/kernel/ref.c. Part of level.wgsl and choose.wgsl, which bind the grid.

const JUMP_FROM: f32 = 2.0; // less, and a step to the next pixel edge gets as far
const ENTRY_SLACK: f32 = 0.03125; // by which the point where a ray enters may round to outside
const TWO_HALF_DIAGONALS: f32 = 1.41421368;
const NEVER: f32 = 1e30; // stands for 1/0
const NOWHERE: u32 = 0xffffffffu; // no pixel

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

fn inverse_or_never(d: vec2f) -> vec2f {
    return select(vec2f(NEVER), 1.0 / d, d != vec2f(0.0));
}

fn ray_between(start: vec2f, end: vec2f) -> Ray {
    var ray: Ray;
    let d = end - start;
    ray.start = start;
    ray.reach = sqrt(d.x * d.x + d.y * d.y);
    ray.direction = d * inverse_or_never(vec2f(ray.reach));
    ray.inverse = inverse_or_never(ray.direction);
    let back = ray.direction < vec2f(0.0);
    ray.step = select(vec2i(1), vec2i(-1), back);
    ray.side = select(vec2i(1), vec2i(0), back);
    return ray;
}

// Where a ray enters [0, size], axis by axis.
fn enter(ray: Ray, size: vec2f) -> vec2f {
    let from_below = select(vec2f(NEVER), -ray.start * ray.inverse, ray.direction > vec2f(0.0));
    let from_above = select(vec2f(NEVER), (size - ray.start) * ray.inverse, ray.direction < vec2f(0.0));
    return select(select(vec2f(0.0), from_above, ray.start > size), from_below, ray.start < vec2f(0.0));
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

// The pixel of a place, or NOWHERE outside the picture.
fn cell_of(at: vec2i, bounds: vec2u) -> u32 {
    let place = vec2u(at);
    return select(NOWHERE, place.y * bounds.x + place.x, place.x < bounds.x && place.y < bounds.y);
}

// Jumps and steps have loops of their own: what runs rays in lockstep pays for one of them at a time.
fn march(start: vec2f, end: vec2f, picture: vec2u) -> Interval {
    let ray = ray_between(start, end);
    let size = vec2f(picture);
    var gathered = Interval(vec3f(0.0), vec3f(1.0));
    let entered = enter(ray, size);
    var t = max(entered.x, entered.y);
    let entry = start + t * ray.direction;
    let passes_by = t > 0.0 && (any(entry < vec2f(-ENTRY_SLACK)) || any(entry > size + ENTRY_SLACK)); // a corner
    var at = vec2i(floor(entry));
    at = select(at, clamp(at, vec2i(0), vec2i(picture) - 1), t > 0.0);
    var cell = select(cell_of(at, picture), NOWHERE, passes_by || !(t < ray.reach));
    while (cell != NOWHERE) {
        var free = clearance[cell];
        while (free >= JUMP_FROM) {
            t += free - TWO_HALF_DIAGONALS;
            at = vec2i(floor(start + t * ray.direction));
            cell = select(cell_of(at, picture), NOWHERE, t >= ray.reach);
            free = select(clearance[cell], 0.0, cell == NOWHERE);
        }
        while (cell != NOWHERE && free < JUMP_FROM) {
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
            t = leave;
            let along = edge.x <= edge.y; // an exact corner looks at the neighbour in x first
            at += select(vec2i(0, ray.step.y), vec2i(ray.step.x, 0), along);
            cell = select(cell_of(at, picture), NOWHERE, t >= ray.reach);
            free = clearance[cell];
        }
    }
    return gathered;
}
