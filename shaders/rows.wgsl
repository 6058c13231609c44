// Rows of T and R as textures: x counts the rows of the world, y the rays or cones of all columns. Read at the middle of
// a texel, which gives its value as it is. A software adapter takes half as long for that as for three numbers of a
// buffer; textureLoad(), which checks the place twice, takes longer than those.

@group(0) @binding(10) var nearest: sampler; // of one texel

// How wide and high a texel is.
fn texel_of(rows: texture_2d<f32>) -> vec2f {
    return 1.0 / vec2f(textureDimensions(rows));
}

fn middle_of(index: i32, texel: f32) -> f32 {
    return (f32(index) + 0.5) * texel;
}
