// The mean over all four quadrants, from the sums of both axes (src/holographic/band.c). The two lie across each other: by
// tiles, whose four rows are a line of the cache of the one across.

@group(0) @binding(2) var sums_along_x: texture_2d<f32>; // [x][y]
@group(0) @binding(3) var sums_along_y: texture_2d<f32>; // [y][x]
@group(0) @binding(4) var means: texture_storage_2d<rgba32float, write>; // [y][x]; in a: 1 where a pixel is free

fn sum_at(sums: texture_2d<f32>, column: u32, row: u32) -> vec3f {
    let texel = texel_of(sums);
    let at = vec2f(middle_of(i32(row), texel.x), middle_of(i32(column), texel.y));
    return textureSampleLevel(sums, nearest, at, 0.0).rgb;
}

@compute @workgroup_size(64, 4)
fn mean(@builtin(global_invocation_id) id: vec3u) {
    let pixel = min(id.xy, picture.size - 1u);
    let light = 0.25 * sum_at(sums_along_x, pixel.x, pixel.y) + 0.25 * sum_at(sums_along_y, pixel.y, pixel.x);
    let is_opaque = emission[pixel.y * picture.size.x + pixel.x].w == OPAQUE;
    textureStore(means, pixel, vec4f(light, select(1.0, 0.0, is_opaque)));
}
