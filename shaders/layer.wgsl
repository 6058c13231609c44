// From the caller's planes to pixels, as src/field/layer.c does it: what a pixel is, its emission and its extinction.
// First step of every solve.

struct World {
    size: vec2u, // [px]
}

override MEDIA: bool = true; // some pixel is a medium

const EMPTY: u32 = 0u;
const MEDIUM: u32 = 1u;

const INFINITY_BITS: u32 = 0x7f800000u;
const EXTINCTION_MAX: f32 = 1e30;

@group(0) @binding(0) var<uniform> world: World;
@group(0) @binding(1) var<storage, read> emission_plane: array<f32>; // [pixel][3]
// [pixel][3], as bits: WGSL does not promise to keep an infinite float.
@group(0) @binding(2) var<storage, read> extinction_plane: array<u32>;
// [pixel]: RGB and what the pixel is: 0 empty, 1 a medium, 2 opaque.
@group(0) @binding(3) var<storage, read_write> emission: array<vec4f>;
// [pixel]: RGB, 0 unless it is a medium. Written where there are MEDIA alone.
@group(0) @binding(4) var<storage, read_write> extinction: array<vec4f>;
@group(0) @binding(5) var<storage, read> kinds: array<u32>; // what pixels are, a byte each

@compute @workgroup_size(GROUP)
fn draw(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u,
        @builtin(local_invocation_index) local: u32) {
    let pixel = item_of(group, groups, local);
    if (pixel >= world.size.x * world.size.y) {
        return;
    }
    let at = 3u * pixel;
    let kind = (kinds[pixel / 4u] >> (8u * (pixel % 4u))) & 0xffu;
    let shown = vec3f(emission_plane[at], emission_plane[at + 1u], emission_plane[at + 2u]);
    emission[pixel] = vec4f(select(vec3f(0.0), shown, kind != EMPTY), f32(kind));
    if (MEDIA) {
        let bits = vec3u(extinction_plane[at], extinction_plane[at + 1u], extinction_plane[at + 2u]);
        let infinite = bits == vec3u(INFINITY_BITS);
        let through = select(bitcast<vec3f>(select(bits, vec3u(0u), infinite)), vec3f(EXTINCTION_MAX), infinite);
        extinction[pixel] = vec4f(select(vec3f(0.0), min(through, vec3f(EXTINCTION_MAX)), kind == MEDIUM), 0.0);
    }
}
