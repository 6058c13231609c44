// One ray through the pixel world: exact traversal that jumps over what the clearance proves empty. Operation for
// operation march() of src/kernel/ref.c. Part of level.wgsl and choose.wgsl, which bind the grid.

const JUMP_FROM: f32 = 2.0; // less, and a step to the next pixel edge gets as far
const ENTRY_SLACK: f32 = 0.03125; // by which the point where a ray enters may round to outside
const TWO_HALF_DIAGONALS: f32 = 1.41421368;
const NEVER: f32 = 1e30; // stands for 1/0

// Clearance of a texel: more than 0 empty, 0 a medium, or
const OPAQUE: f32 = -1.0;
const OUTSIDE: f32 = -2.0;

override MEDIA: bool = false; // some pixel is a medium

override ENTERS: bool = true; // rays may begin outside the picture and enter it

@group(0) @binding(1) var grid: texture_2d<f32>; // as grid.wgsl leaves it
@group(0) @binding(3) var<storage, read> extinction: array<vec4f>; // [pixel]; read where the clearance is 0

// What all rays of a kernel share.
struct Walk {
    size: vec2f, // of the picture [px]
    texel: vec2f, // of the grid
}

struct Ray {
    start: vec2f,
    direction: vec2f,
    inverse: vec2f,
    reach: f32,
    step: vec2f, // -1 or 1
    side: vec2f, // which edge of a pixel it leaves by: 0 or 1
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
    ray.step = select(vec2f(1.0), vec2f(-1.0), back);
    ray.side = select(vec2f(1.0), vec2f(0.0), back);
    return ray;
}

// Where a ray enters [0, size], axis by axis.
fn enter(ray: Ray, size: vec2f) -> vec2f {
    let from_below = select(vec2f(NEVER), -ray.start * ray.inverse, ray.direction > vec2f(0.0));
    let from_above = select(vec2f(NEVER), (size - ray.start) * ray.inverse, ray.direction < vec2f(0.0));
    return select(select(vec2f(0.0), from_above, ray.start > size), from_below, ray.start < vec2f(0.0));
}

fn cross_medium(gathered: Interval, at: vec2f, emission: vec3f, stretch: f32, walk: Walk) -> Interval {
    let thickness = extinction[u32(at.y) * u32(walk.size.x) + u32(at.x)].rgb * stretch;
    let through = vec3f(exp_negative(thickness.r), exp_negative(thickness.g), exp_negative(thickness.b));
    return Interval(gathered.radiance + gathered.passed * (emission * (1.0 - through)), gathered.passed * through);
}

fn walk_through(picture: vec2u) -> Walk {
    return Walk(vec2f(picture), texel_of(grid));
}

// What a ray meets between two points, if it is known to meet nothing on a share of its way.
//
// A round of the loop looks at one pixel and goes on from it, by a jump or to the next pixel: both are computed, for what
// runs rays in lockstep would do so anyway. The loop is asked at its end: then it takes no round too many.
fn march(start: vec2f, end: vec2f, free: f32, walk: Walk) -> Interval {
    let ray = ray_between(start, end);
    var t = free * ray.reach;
    var at = floor(start + t * ray.direction); // in whole numbers: a pixel
    if (ENTERS) {
        let entered = enter(ray, walk.size);
        t = max(t, max(entered.x, entered.y));
        let entry = start + t * ray.direction;
        let passes_by = any(entry < vec2f(-ENTRY_SLACK)) | any(entry > walk.size + ENTRY_SLACK); // a corner
        at = select(at, clamp(floor(entry), vec2f(0.0), walk.size - 1.0), t > 0.0);
        at = select(at, vec2f(-1.0), ((t > 0.0) & passes_by) | !(t < ray.reach));
    }
    var gathered = Interval(vec3f(0.0), vec3f(1.0));
    var here: vec4f;
    loop {
        here = textureSampleLevel(grid, nearest, (at + 1.5) * walk.texel, 0.0);
        let room = here.w;
        let edge = (at + ray.side - start) * ray.inverse;
        let leave = min(edge.x, edge.y);
        if (MEDIA) {
            let until = min(leave, ray.reach);
            if ((room == 0.0) & (until > t)) {
                gathered = cross_medium(gathered, at, here.rgb, until - t, walk);
            }
        }
        let landed = t + (room - TWO_HALF_DIAGONALS);
        let jumps = room >= JUMP_FROM;
        let along = edge.x <= edge.y; // an exact corner looks at the neighbour in x first
        let next = at + select(vec2f(0.0, ray.step.y), vec2f(ray.step.x, 0.0), along);
        t = select(leave, landed, jumps);
        at = select(next, floor(start + t * ray.direction), jumps);
        continuing {
            break if !((room >= 0.0) & (t < ray.reach));
        }
    }
    let hits = here.w == OPAQUE;
    return Interval(gathered.radiance + gathered.passed * select(vec3f(0.0), here.rgb, hits),
                    select(gathered.passed, vec3f(0.0), hits));
}
