// The exact Euclidean distance transform, in integers, of src/field/distance.c (Meijster, Roerdink, Hesselink 2000):
// `columns` finds the distance to the nearest pixel of a column that is not empty, `rows` the lower envelope of the
// parabolas that those put up. Writes the clearance that grid.wgsl and near.wgsl read.

struct World {
    size: vec2u, // [px]
}

const EMPTY: f32 = 0.0;
const OPAQUE: f32 = 2.0;

@group(0) @binding(0) var<uniform> world: World;
@group(0) @binding(1) var<storage, read> emission: array<vec4f>; // RGB, and what the pixel is: web/webgpu/world.js
@group(0) @binding(2) var<storage, read_write> runs: array<i32>; // [y][x]: distances within a column
@group(0) @binding(3) var<storage, read_write> envelope: array<vec2i>; // [y][k]: owner of parabola k, and its start
@group(0) @binding(4) var<storage, read_write> clearance: array<f32>;

// An item is a column.
@compute @workgroup_size(GROUP)
fn columns(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u,
           @builtin(local_invocation_index) local: u32) {
    let x = item_of(group, groups, local);
    let width = world.size.x;
    let nowhere = i32(world.size.x + world.size.y);
    if (x >= width) {
        return;
    }
    var run = nowhere;
    for (var y = 0u; y < world.size.y; y++) {
        let cell = y * width + x;
        run = select(min(run + 1, nowhere), 0, emission[cell].w != EMPTY);
        runs[cell] = run;
    }
    for (var y = world.size.y - 1u; y > 0u; y--) {
        let cell = (y - 1u) * width + x;
        run = min(runs[cell], run + 1);
        runs[cell] = run;
    }
}

// Squared distance at x to the nearest occupied pixel of column `owner`, whose column distance is `run`.
fn parabola(x: i32, owner: i32, run: i32) -> i32 {
    return (x - owner) * (x - owner) + run * run;
}

fn clearance_of(kind: f32, squared: i32) -> f32 {
    if (kind == EMPTY) {
        return sqrt(f32(squared));
    }
    return select(0.0, -1.0, kind == OPAQUE);
}

// Lower envelope of a row: from `envelope[k].y` on the parabola of column `envelope[k].x` is the lowest. Returns the
// last k.
fn lower_envelope(row: u32) -> i32 {
    let width = i32(world.size.x);
    var top = 0;
    envelope[row] = vec2i(0, 0);
    for (var u = 1; u < width; u++) {
        let run = runs[row + u32(u)];
        var last = vec2i(0, 0);
        var last_run = 0;
        while (top >= 0) {
            last = envelope[row + u32(top)];
            last_run = runs[row + u32(last.x)];
            if (parabola(last.y, last.x, last_run) <= parabola(last.y, u, run)) {
                break;
            }
            top--;
        }
        if (top < 0) {
            top = 0;
            envelope[row] = vec2i(u, 0);
            continue;
        }
        let meet = 1 + (u * u - last.x * last.x + run * run - last_run * last_run) / (2 * (u - last.x));
        if (meet < width) {
            top++;
            envelope[row + u32(top)] = vec2i(u, meet);
        }
    }
    return top;
}

// An item is a row.
@compute @workgroup_size(GROUP)
fn rows(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u,
        @builtin(local_invocation_index) local: u32) {
    let y = item_of(group, groups, local);
    if (y >= world.size.y) {
        return;
    }
    let row = y * world.size.x;
    var top = lower_envelope(row);
    for (var x = i32(world.size.x) - 1; x >= 0; x--) {
        let cell = row + u32(x);
        let lowest = envelope[row + u32(top)];
        let squared = parabola(x, lowest.x, runs[row + u32(lowest.x)]);
        clearance[cell] = clearance_of(emission[cell].w, squared);
        top -= select(0, 1, x == lowest.y);
    }
}
