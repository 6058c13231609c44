// From the probes of level 0, one in every pixel, to the picture (src/cascade/pixels.c): they have one slot;
// opaque pixels show their emission.

struct Picture {
    size: vec2u, // [px]
}

const OPAQUE: f32 = 2.0;

@group(0) @binding(0) var<uniform> picture: Picture;
@group(0) @binding(1) var<storage, read> emission: array<vec4f>; // RGB, and what the pixel is: web/webgpu/world.js
@group(0) @binding(2) var radiance: texture_2d<f32>; // as level.wgsl leaves it
@group(0) @binding(3) var<storage, read_write> light: array<f32>; // [pixel][3]

@compute @workgroup_size(GROUP)
fn show(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u,
        @builtin(local_invocation_index) local: u32) {
    let pixel = item_of(group, groups, local);
    let pixels = picture.size.x * picture.size.y;
    if (pixel >= pixels) {
        return;
    }
    let row = pixel / picture.size.x;
    let at = vec2i(i32(pixel - row * picture.size.x), i32(row));
    let texel = texel_of(radiance);
    let seen = textureSampleLevel(radiance, nearest, vec2f(middle_of(at.x, texel.x), middle_of(at.y, texel.y)), 0.0);
    let own = emission[pixel];
    let shown = select(seen, own, own.w == OPAQUE);
    light[3u * pixel] = shown.r;
    light[3u * pixel + 1u] = shown.g;
    light[3u * pixel + 2u] = shown.b;
}
