// The pixels of a world, and which of them lie beside lamps. Part of rims.wgsl and finish.wgsl.

struct Picture {
    size: vec2u, // [px]
}

const OPAQUE: f32 = 2.0;
const RIM: i32 = 2; // of a lamp: what is at most so many rows and columns away

@group(0) @binding(0) var<uniform> picture: Picture;
@group(0) @binding(1) var<storage, read> emission: array<vec4f>; // as layer.wgsl leaves it
@group(0) @binding(6) var<storage, read> clearance: array<f32>; // as distance.wgsl leaves it

fn is_inside(x: i32, y: i32) -> bool {
    return x >= 0 && y >= 0 && x < i32(picture.size.x) && y < i32(picture.size.y);
}

fn is_opaque(x: i32, y: i32) -> bool {
    return is_inside(x, y) && emission[y * i32(picture.size.x) + x].w == OPAQUE;
}

fn is_free(x: i32, y: i32) -> bool {
    return is_inside(x, y) && emission[y * i32(picture.size.x) + x].w != OPAQUE;
}

fn is_lamp(x: i32, y: i32) -> bool {
    return is_opaque(x, y) && any(emission[y * i32(picture.size.x) + x].rgb > vec3f(0.0));
}

fn is_beside_lamps(x: i32, y: i32, reach: i32) -> bool {
    if (clearance[y * i32(picture.size.x) + x] > 2.0 * f32(reach)) {
        return false;
    }
    for (var dy = -reach; dy <= reach; dy++) {
        for (var dx = -reach; dx <= reach; dx++) {
            if (is_lamp(x + dx, y + dy)) {
                return true;
            }
        }
    }
    return false;
}
