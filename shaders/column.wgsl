// The two steps that holographic radiance cascades are made of (src/holographic/column.c): segments of twice the
// length, and radiance merged from the level above. Groups are counted by ray or cone, column, and word of blocks.
//
// Everything is loaded from where it would be, and replaced where that is clear or outside the world: a software adapter
// computes both sides of a branch anyway. What is the same in all rounds of a loop is named before it.

@group(0) @binding(1) var<storage, read> own: array<Interval>; // T: [column][ray][row]; its blocks are `blocks`
@group(0) @binding(2) var<storage, read_write> longer: array<Interval>; // extend: T of the level above
@group(0) @binding(3) var<storage, read_write> longer_blocks: array<u32>; // and its blocks
@group(0) @binding(4) var<storage, read_write> radiance: array<vec3f>; // R of the quadrant's level: [column][cone][row]

fn has(blocks: u32, block: u32) -> bool {
    return (blocks & block) != 0u;
}

// T, if it is not clear there.
fn own_at(at: i32, is_any: bool) -> Interval {
    return choose(nothing(), own[at], is_any);
}

// Rays 2k and 2k+1 of the level above from rays k and k+1, which are half as long. Beyond the world there is nothing.
@compute @workgroup_size(BLOCK)
fn extend(@builtin(local_invocation_index) local: u32, @builtin(workgroup_id) id: vec3u) {
    let lane = i32(local);
    let k = i32(id.x);
    let p = i32(id.y) + 1;
    let word = i32(id.z);
    let length = quadrant.length;
    let rise = 2 * k - quadrant.reach;
    let is_between = k < quadrant.reach; // is there a ray 2k+1?
    let is_there = 2 * p + 1 < quadrant.columns;
    let here = row_of(quadrant.reach, 2 * p, k);
    let there = row_of(quadrant.reach, 2 * p + 1, k);
    let out = row_of(2 * quadrant.reach, p, 2 * k);

    let near = word_of(here, word);
    let near_next = select(0u, word_of(here + 1, word), is_between);
    let far = seen_from(there, word, rise, lane, is_there);
    let far_next = seen_from(there + 1, word, rise, lane, is_there & is_between);
    let far_beyond = seen_from(there, word, rise + 2, lane, is_there & is_between);
    let found = near | far.all;
    let found_between = near | near_next | far_next.all | far_beyond.all;
    longer_blocks[out * quadrant.words + word] = found;
    if (is_between) {
        longer_blocks[(out + 1) * quadrant.words + word] = found_between;
    }

    var left = some_of(found | found_between);
    loop {
        let y = row_in(word, left, lane);
        let end = y + rise;
        let block = lowest(left);
        let is_inside = u32(end) < u32(length);
        let is_beyond_inside = u32(end + 2) < u32(length);
        let first = own_at(here * length + y, has(near, block));
        let next = own_at((here + 1) * length + y, has(near_next, block));
        let second = own_at(there * length + end, has(far.mine, block) & is_inside);
        let second_next = own_at((there + 1) * length + end, has(far_next.mine, block) & is_inside);
        let second_beyond = own_at(there * length + end + 2, has(far_beyond.mine, block) & is_beyond_inside);
        if (y < length) {
            longer[out * length + y] = compose(first, second);
            if (is_between) {
                let low = compose(first, second_next);
                let high = compose(next, second_beyond);
                longer[(out + 1) * length + y] = mean_of(low, high);
            }
        }
        continuing {
            left &= left - 1u;
            break if left == 0u;
        }
    }
}

// A cone of an odd column: what its two rays bring, and behind them the next column of the level above.
struct Odd {
    segment: i32,
    there: i32,
    out: i32,
    rise: i32,
    rows: u32,
    weight: vec2f,
    behind: vec3f,
}

fn odd_of(i: i32, q: i32) -> Odd {
    let above_reach = 2 * quadrant.reach;
    return Odd(row_of(quadrant.reach, 2 * q + 1, i), cone_at(above_reach, q + 1, 2 * i),
               cone_at(quadrant.reach, 2 * q + 1, i), 2 * i - quadrant.reach, rows_of(q + 1, quadrant.columns_above),
               weights[quadrant.reach + i], sky);
}

fn merge_odd_at(of_cone: Odd, length: i32, y: i32, low: Interval, high: Interval) {
    let end = y + of_cone.rise;
    let beyond_low = through(low, light_above(of_cone.behind, of_cone.there, end, of_cone.rows));
    let beyond_high = through(high, light_above(of_cone.behind, of_cone.there + length, end + 2, of_cone.rows));
    if (y < length) {
        radiance[of_cone.out + y] =
            weighed(of_cone.weight.x, low, beyond_low) + weighed(of_cone.weight.y, high, beyond_high);
    }
}

@compute @workgroup_size(BLOCK)
fn merge_odd(@builtin(local_invocation_index) local: u32, @builtin(workgroup_id) id: vec3u) {
    let lane = i32(local);
    let word = i32(id.z);
    let length = quadrant.length;
    let cone = odd_of(i32(id.x), i32(id.y));
    let low = word_of(cone.segment, word);
    let high = word_of(cone.segment + 1, word);

    var left = some_of(blocks_in(word) & ~(low | high));
    loop {
        merge_odd_at(cone, length, row_in(word, left, lane), nothing(), nothing());
        continuing {
            left &= left - 1u;
            break if left == 0u;
        }
    }
    left = some_of(low | high);
    loop {
        let y = row_in(word, left, lane);
        let block = lowest(left);
        let low_segment = own_at(cone.segment * length + y, has(low, block));
        let high_segment = own_at((cone.segment + 1) * length + y, has(high, block));
        merge_odd_at(cone, length, y, low_segment, high_segment);
        continuing {
            left &= left - 1u;
            break if left == 0u;
        }
    }
}

// A cone of an even column, which the level above has too: half of it from here, half from the end of its segments.
struct Even {
    segment: i32, // of the level above
    here: i32,
    there: i32,
    out: i32,
    rise: i32,
    rows: u32,
    weight: vec2f,
    behind: vec3f,
}

fn even_of(i: i32, q: i32) -> Even {
    let above_reach = 2 * quadrant.reach;
    return Even(row_of(above_reach, q, 2 * i), cone_at(above_reach, q, 2 * i), cone_at(above_reach, q + 1, 2 * i),
                cone_at(quadrant.reach, 2 * q, i), 2 * (2 * i - quadrant.reach),
                rows_of(q + 1, quadrant.columns_above), 0.5 * weights[quadrant.reach + i], sky);
}

fn merge_even_at(of_cone: Even, length: i32, y: i32, low: Interval, high: Interval) {
    let end = y + of_cone.rise;
    let beyond_low =
        through(low, light_above(of_cone.behind, of_cone.there, end, of_cone.rows)) + above[of_cone.here + y];
    let beyond_high = through(high, light_above(of_cone.behind, of_cone.there + length, end + 4, of_cone.rows)) +
                      above[of_cone.here + length + y];
    if (y < length) {
        radiance[of_cone.out + y] =
            weighed(of_cone.weight.x, low, beyond_low) + weighed(of_cone.weight.y, high, beyond_high);
    }
}

@compute @workgroup_size(BLOCK)
fn merge_even(@builtin(local_invocation_index) local: u32, @builtin(workgroup_id) id: vec3u) {
    let lane = i32(local);
    let word = i32(id.z);
    let length = quadrant.length;
    let cone = even_of(i32(id.x), i32(id.y) + 1);
    let low = word_of(cone.segment, word);
    let high = word_of(cone.segment + 2, word);

    var left = some_of(blocks_in(word) & ~(low | high));
    loop {
        merge_even_at(cone, length, row_in(word, left, lane), nothing(), nothing());
        continuing {
            left &= left - 1u;
            break if left == 0u;
        }
    }
    left = some_of(low | high);
    loop {
        let y = row_in(word, left, lane);
        let block = lowest(left);
        let low_segment = own_at(cone.segment * length + y, has(low, block));
        let high_segment = own_at((cone.segment + 2) * length + y, has(high, block));
        merge_even_at(cone, length, y, low_segment, high_segment);
        continuing {
            left &= left - 1u;
            break if left == 0u;
        }
    }
}
