// Writes T down with one transmittance; keep_rgb.wgsl is the other. The texture is no parameter: naga, which Firefox compiles with,
// knows no storage textures handed to functions.

@group(0) @binding(4) var segments: texture_storage_2d<rgba32float, write>; // of one level: [column][ray][row]

fn keep_interval(y: i32, row: i32, value: Interval) {
    textureStore(segments, vec2i(y, row), value);
}
