// Segments of twice the length, of the level above (src/holographic/column.c). Groups are counted by ray, column and
// window of blocks.
//
// Everything is loaded from where it would be, and replaced where that is clear or outside the world: a software adapter
// computes both sides of a branch anyway. What is the same in all rounds of a loop is named before it.

// What the straight ray counts beside the mean of two ways with a bend (src/kernel/rows.h).
const STRAIGHT_PART: f32 = 0.3125;

override BETWEEN: bool = false; // to level 3: a part of rays in between is the straight one

@group(0) @binding(1) var own: texture_2d<f32>; // T of the quadrant's level: [column][ray][row]
@group(0) @binding(2) var between_rays: texture_2d<f32>; // straight rays of level 3: [column][ray][row]

// Ray k and the next of one column, and of the column where they end.
struct Rays {
    here: f32, // place of ray k
    there: f32,
    out: i32, // row of ray 2k
    rise: i32,
    length: i32,
    texel: vec2f,
    is_between: bool, // is there a next ray?
    near: Window,
    near_next: Window,
    far: Shifted,
    far_next: Shifted,
    straight: f32, // place of the straight ray in between
    straight_texel: vec2f,
    straight_found: Window,
}

fn rays_of(k: i32, p: i32, first: i32) -> Rays {
    let texel = texel_of(own);
    let rise = 2 * k - quadrant.reach;
    let here = row_of(quadrant.reach, 2 * p, k);
    let there = row_of(quadrant.reach, 2 * p + 1, k);
    let is_there = 2 * p + 1 < quadrant.columns;
    let is_between = k < quadrant.reach;
    let near = window_of(quadrant.rows + here, first, true);
    let near_next = window_of(quadrant.rows + here + 1, first, is_between);
    let far = shifted_of(quadrant.rows + there, first, rise, is_there);
    let far_next = shifted_of(quadrant.rows + there + 1, first, rise, is_there & is_between);
    let straight_row = between_row_of(p, k);
    var straight_texel = vec2f(0.0);
    var straight_found = Window(0u);
    if (BETWEEN) {
        straight_texel = texel_of(between_rays);
        straight_found = window_of(quadrant.rows_between + straight_row, first, is_between);
    }
    return Rays(middle_of(PLANES * here, texel.y), middle_of(PLANES * there, texel.y),
                row_of(2 * quadrant.reach, p, 2 * k), rise, quadrant.length, texel, is_between, near, near_next, far,
                far_next, middle_of(PLANES * straight_row, straight_texel.y), straight_texel, straight_found);
}

// T where it is neither clear nor outside the world.
fn own_at(rays: Rays, ray: f32, y: i32, is_any: bool) -> Interval {
    let at = vec2f(middle_of(y, rays.texel.x), ray);
    return choose(nothing(), interval_at(own, at, rays.texel), is_any);
}

fn next_ray(rays: Rays, ray: f32) -> f32 {
    return ray + f32(PLANES) * rays.texel.y;
}

// What ray k of the far column brings to a row of a block.
fn far_at(rays: Rays, block: Window, begin: i32, row: i32) -> Interval {
    let end = begin + row + rays.rise;
    return own_at(rays, rays.there, end, sees(rays.far, block, row) & (u32(end) < u32(rays.length)));
}

// Blocks that are not clear, of both rays of the level above.
struct Kept {
    at: Window,
    between: Window,
}

// One row of a block, where ray k ends at `second`. Returns where that of the invocation's next row ends.
fn extend_row(rays: Rays, block: Window, begin: i32, row: i32, second: Interval,
              kept: ptr<function, Kept>) -> Interval {
    let y = begin + row;
    let end = y + rays.rise;
    let is_inside = u32(end) < u32(rays.length);
    let first = own_at(rays, rays.here, y, has(rays.near, block));
    let next = own_at(rays, next_ray(rays, rays.here), y, has(rays.near_next, block));
    let second_next =
        own_at(rays, next_ray(rays, rays.there), end, sees(rays.far_next, block, row) & is_inside);
    let beyond = far_at(rays, block, begin, row + ROW_STEP);
    let seen = compose(first, second);
    var between = mean_of(compose(first, second_next), compose(next, beyond));
    if (BETWEEN) {
        let at = vec2f(middle_of(y, rays.straight_texel.x), rays.straight);
        let straight = interval_at(between_rays, at, rays.straight_texel);
        between = parts_of(between, choose(nothing(), straight, has(rays.straight_found, block)),
                           STRAIGHT_PART);
    }
    keep_interval(kept_at(y, true), rays.out, seen);
    keep_interval(kept_at(y, rays.is_between), rays.out + 1, between);
    // Always so in worlds of whole blocks; but without this branch SwiftShader of Chromium 156 gave other masks there,
    // and why is not understood.
    if (y < rays.length) {
        kept.at |= select(block, Window(0u), is_clear(seen));
        kept.between |= select(block, Window(0u), is_clear(between));
    }
    return beyond;
}

// Rays 2k and 2k+1 of the level above from rays k and k+1, which are half as long.
@compute @workgroup_size(LANES)
fn extend(@builtin(local_invocation_index) lane: u32, @builtin(workgroup_id) id: vec3u) {
    let k = i32(id.x);
    let p = i32(id.y) + 1;
    let first = i32(id.z) * WINDOW;
    let rays = rays_of(k, p, first);
    let found = rays.near | all_of(rays.far);
    let found_between = rays.near | rays.near_next | rays.far.low | rays.far.high | all_of(rays.far_next) |
        rays.straight_found;
    let row = first_row(lane);
    var kept: Kept;
    var left = some_of(select(found, found_between, rays.is_between));
    loop {
        let block = lowest(left);
        let begin = (first + number_of(block)) * BLOCK;
        var second = far_at(rays, block, begin, row);
        var i = 0;
        loop {
            second = extend_row(rays, block, begin, row + i, second, &kept);
            continuing {
                i += ROW_STEP;
                break if i == ROWS * ROW_STEP;
            }
        }
        continuing {
            left ^= block;
            break if !is_any(left);
        }
    }
    keep_window(quadrant.rows_above + rays.out, first, kept.at);
    if (rays.is_between) {
        keep_window(quadrant.rows_above + rays.out + 1, first, kept.between);
    }
}
