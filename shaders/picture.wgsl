// The pixels of a world. Part of the kernels that come after the last quadrant: mean, finish, mark, list, look, rims.

struct Picture {
    size: vec2u, // [px]
}

const OPAQUE: f32 = 2.0;

@group(0) @binding(0) var<uniform> picture: Picture;
@group(0) @binding(1) var<storage, read> emission: array<vec4f>; // RGB, and what the pixel is: web/webgpu/world.js
