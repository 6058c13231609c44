// The filter beside lamps (src/holographic/rims.c: dpl_hrc_filter_rims): light from near, which falls off too steeply
// for any filter, is taken off before and put back after.

@group(0) @binding(7) var<storage, read> near: array<vec4f>; // as look.wgsl leaves it
@group(0) @binding(8) var<storage, read> count: u32;
@group(0) @binding(9) var<storage, read> listed: array<u32>; // as list.wgsl leaves it

// How much larger than they are the sums show lamps near.
const SHOWN_LARGER: f32 = 0.25;

// Neighbours, each of which stands for the one opposite too; diagonal ones weigh half. Written one by one instead of in
// a loop they take a software adapter minutes to compile.
const PAIRS = array(vec2i(1, 0), vec2i(0, 1), vec2i(1, 1), vec2i(1, -1));

// What a pixel and its neighbours add up to.
struct Total {
    light: vec3f,
    near: vec3f, // as large as `light` shows it
    open: f32, // and what that leaves
}

// Lamps near that take a share of all directions are shown larger than they are, unless the share is negative.
fn add(total: ptr<function, Total>, x: i32, y: i32, weight: f32) {
    let here = near[y * i32(picture.size.x) + x];
    let share = abs(here.w);
    let open = 1.0 - share;
    let larger = select(SHOWN_LARGER * (share - 0.25), 0.0, here.w < 0.0);
    (*total).light += weight * at(x, y).rgb;
    (*total).near += weight * here.rgb * (1.0 + open * larger);
    (*total).open += weight * (open * (1.0 - share * larger));
}

fn is_free(x: i32, y: i32) -> bool {
    return at(x, y).w > 0.0;
}

// Walls that touch at a corner let nothing through: between two of them no neighbour is reached.
fn is_reached(x: i32, y: i32, dx: i32, dy: i32) -> bool {
    return is_free(x + dx, y + dy) && (is_free(x + dx, y) || is_free(x, y + dy));
}

// Two neighbours opposite each other.
fn add_pair(total: ptr<function, Total>, x: i32, y: i32, dx: i32, dy: i32, weight: f32) {
    if (!is_reached(x, y, dx, dy) || !is_reached(x, y, -dx, -dy)) {
        return;
    }
    add(total, x + dx, y + dy, weight);
    add(total, x - dx, y - dy, weight);
}

// What comes from further away comes through what is open. Where there is less light than from near, there is a medium
// in between: what is left of it falls off all the same.
fn filter_rim(x: i32, y: i32) -> vec3f {
    let here = near[y * i32(picture.size.x) + x];
    var total = Total(vec3f(0.0), vec3f(0.0), 0.0);
    add(&total, x, y, 4.0);
    for (var i = 0; i < 4; i++) {
        add_pair(&total, x, y, PAIRS[i].x, PAIRS[i].y, select(2.0, 1.0, i >= 2));
    }
    let further = (total.light - total.near) * select(0.0, (1.0 - abs(here.w)) / total.open, total.open > 0.0);
    let left = total.light / max(total.near, vec3f(1e-37));
    return select(here.rgb + further, here.rgb * left, total.light < total.near);
}

@compute @workgroup_size(GROUP)
fn mend(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u,
        @builtin(local_invocation_index) local: u32) {
    var i = item_of(group, groups, local);
    loop {
        let pixel = listed[i] & ~ON_RIM;
        let y = pixel / picture.size.x;
        let shown = filter_rim(i32(pixel - y * picture.size.x), i32(y));
        if (i < count && listed[i] >= ON_RIM) {
            keep(pixel, shown);
        }
        continuing {
            i += groups.x * groups.y * GROUP;
            break if i >= count;
        }
    }
}
