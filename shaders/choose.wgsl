// What rings of rays see from points all over the picture (src/cascade/choose.c): from this the signals are computed
// that pick how many rays a frame leaves out. Dispatched before the levels where that is asked for.

struct Rings {
    picture: vec2u, // [px]
    rays: u32,
}

@group(0) @binding(0) var<uniform> rings: Rings;
@group(0) @binding(4) var<storage, read> segments: array<vec4f>; // [ray]: start and end [px]
@group(0) @binding(5) var<storage, read_write> seen: array<vec4f>; // [ray][2]: radiance, share that passes

@compute @workgroup_size(GROUP)
fn look(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u,
        @builtin(local_invocation_index) local: u32) {
    let ray = item_of(group, groups, local);
    if (ray >= rings.rays) {
        return;
    }
    let interval = march(segments[ray].xy, segments[ray].zw, 0.0, walk_through(rings.picture));
    seen[2u * ray] = vec4f(interval.radiance, 0.0);
    seen[2u * ray + 1u] = vec4f(interval.passed, 0.0);
}
