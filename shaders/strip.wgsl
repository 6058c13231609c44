// T of levels 1 and 2, and straight rays of level 3 in between, traced through pixels (src/holographic/strip.c). Groups
// are counted by column and window. A kernel for each ray: it knows which pixels it crosses.

override REACH: i32 = 2; // of the level; 8: rays in between
override RISE: i32 = 2; // of the ray

@compute @workgroup_size(LANES)
fn trace(@builtin(local_invocation_index) lane: u32, @builtin(workgroup_id) id: vec3u) {
    let p = quadrant.first + i32(id.x) * quadrant.stride;
    let first = i32(id.y) * WINDOW;
    let x = p * REACH;
    let is_between = REACH == 8;
    let row = select(row_of(REACH, p, (RISE + REACH) / 2), between_row_of(p, (RISE + 6) / 4), is_between);
    let found = near_of(x, first, firstTrailingBit(REACH));
    var traced = 0u;
    var kept = Window(0u);
    var left = some_of(found);
    loop {
        let block = lowest(left);
        let begin = (first + number_of(block)) * BLOCK + first_row(lane);
        var y = begin;
        loop {
            let seen = cross(x, y, REACH, RISE);
            keep_interval(kept_at(y, true), row, seen);
            if (y < quadrant.length) {
                kept |= select(block, Window(0u), is_clear(seen));
                traced++;
            }
            continuing {
                y += ROW_STEP;
                break if y == begin + ROWS * ROW_STEP;
            }
        }
        continuing {
            left ^= block;
            break if !is_any(left);
        }
    }
    keep_window(select(quadrant.rows, quadrant.rows_between, is_between) + row, first, kept);
    count(REACH, select(0u, traced, is_any(found)));
}
