// The world of holographic radiance cascades where there are media (src/holographic/world.c): per pixel the light and
// the transmittance of half a chord through it, once in rows for the quadrants that gather along y, once in columns for
// the others.

struct World {
    size: vec2u, // [px]
}

const CHORDS: u32 = 4u; // a pixel is crossed along chords of four kinds
const MEDIUM: f32 = 1.0;
const OPAQUE: f32 = 2.0;
const RADIANCE_MAX: f32 = 1e37;
const EXTINCTION_MAX: f32 = 1e30;
const POINT: u32 = 3u; // a corner has no length: only what is opaque shows there

// Half of the way through a pixel, by slope: along the axis, one across for two along, diagonal [px].
const HALF_CHORDS = array<f32, 3>(0.5, 0.559016994, 0.707106781);

@group(0) @binding(0) var<uniform> world: World;
@group(0) @binding(1) var<storage, read> emission: array<vec4f>; // RGB, and what the pixel is: web/webgpu/world.js
@group(0) @binding(2) var<storage, read> extinction: array<vec4f>;
@group(0) @binding(3) var<storage, read_write> columns: array<Interval>; // [x][y][chord]
@group(0) @binding(4) var<storage, read_write> rows: array<Interval>; // [y][x][chord]

fn through_medium(extinct: vec3f, chord: u32) -> vec3f {
    if (chord == POINT) {
        return select(vec3f(0.0), vec3f(1.0), extinct < vec3f(EXTINCTION_MAX));
    }
    let thickness = extinct * HALF_CHORDS[chord];
    return vec3f(exp_negative(thickness.r), exp_negative(thickness.g), exp_negative(thickness.b));
}

@compute @workgroup_size(GROUP)
fn load(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u,
        @builtin(local_invocation_index) local: u32) {
    let pixel = item_of(group, groups, local);
    if (pixel >= world.size.x * world.size.y) {
        return;
    }
    let y = pixel / world.size.x;
    let x = pixel - y * world.size.x;
    let shown = emission[pixel];
    for (var chord = 0u; chord < CHORDS; chord++) {
        var passed = vec3f(select(1.0, 0.0, shown.w == OPAQUE));
        if (shown.w == MEDIUM) {
            passed = through_medium(extinction[pixel].rgb, chord);
        }
        let cell = interval_of(min(shown.rgb, vec3f(RADIANCE_MAX)) * (1.0 - passed), passed);
        rows[pixel * CHORDS + chord] = cell;
        columns[(x * world.size.y + y) * CHORDS + chord] = cell;
    }
}
