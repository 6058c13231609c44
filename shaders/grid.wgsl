// What rays of cascades walk through: a texel for each pixel, its emission and how far from it there is nothing, and a
// ring of texels around the picture. Sampled without a filter, whatever lies outside is the ring. Made once a frame from
// the pixels and what distance.wgsl leaves; march.wgsl reads it.

struct World {
    size: vec2u, // [px]
}

const OUTSIDE: f32 = -2.0; // as in march.wgsl

@group(0) @binding(0) var<uniform> world: World;
@group(0) @binding(1) var<storage, read> emission: array<vec4f>; // [pixel]
@group(0) @binding(2) var<storage, read> clearance: array<f32>; // [pixel]: > 0 empty, 0 medium, < 0 opaque
@group(0) @binding(3) var grid: texture_storage_2d<rgba32float, write>;

// An item is a texel.
@compute @workgroup_size(GROUP)
fn draw(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u,
        @builtin(local_invocation_index) local: u32) {
    let item = item_of(group, groups, local);
    let row = item / (world.size.x + 2u);
    let at = vec2i(i32(item - row * (world.size.x + 2u)), i32(row)) - 1;
    let inside = clamp(at, vec2i(0), vec2i(world.size) - 1);
    let pixel = inside.y * i32(world.size.x) + inside.x;
    let free = select(OUTSIDE, clearance[pixel], all(at == inside));
    textureStore(grid, at + 1, vec4f(emission[pixel].rgb, free));
}
