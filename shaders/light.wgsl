// The light of a pixel before any filter, and after it. Part of finish.wgsl and rims.wgsl.

@group(0) @binding(2) var means: texture_2d<f32>; // [y][x]: light, and 1 where a pixel is free, as mean.wgsl leaves it
@group(0) @binding(4) var<storage, read_write> light: array<f32>; // [pixel][3]

// Light of a pixel, and 1 where it is free; of walls and beyond the world 0 there.
fn at(x: i32, y: i32) -> vec4f {
    let texel = texel_of(means);
    let found = textureSampleLevel(means, nearest, vec2f(middle_of(x, texel.x), middle_of(y, texel.y)), 0.0);
    return vec4f(found.rgb, select(0.0, found.w, (u32(x) < picture.size.x) & (u32(y) < picture.size.y)));
}

fn keep(pixel: u32, shown: vec3f) {
    light[3u * pixel] = shown.r;
    light[3u * pixel + 1u] = shown.g;
    light[3u * pixel + 2u] = shown.b;
}
