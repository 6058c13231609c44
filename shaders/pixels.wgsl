// From the probes of level 0, one in every pixel, to the picture (src/cascade/pixels.c): the mean over their slots;
// opaque pixels show their emission.

struct Picture {
    size: vec2u, // [px]
    slots: u32,
}

const OPAQUE: f32 = 2.0;

@group(0) @binding(0) var<uniform> picture: Picture;
@group(0) @binding(1) var<storage, read> emission: array<vec4f>; // as layer.wgsl leaves it
@group(0) @binding(2) var<storage, read> radiance: array<vec4f>; // [slot][pixel]
@group(0) @binding(3) var<storage, read_write> light: array<f32>; // [pixel][3]

@compute @workgroup_size(GROUP)
fn show(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u,
        @builtin(local_invocation_index) local: u32) {
    let pixel = item_of(group, groups, local);
    let pixels = picture.size.x * picture.size.y;
    if (pixel >= pixels) {
        return;
    }
    var shown = emission[pixel];
    if (shown.w != OPAQUE) {
        shown = vec4f(0.0);
        for (var slot = 0u; slot < picture.slots; slot++) {
            shown += radiance[slot * pixels + pixel];
        }
        shown /= f32(picture.slots);
    }
    light[3u * pixel] = shown.r;
    light[3u * pixel + 1u] = shown.g;
    light[3u * pixel + 2u] = shown.b;
}
