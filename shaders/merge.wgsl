// Radiance merged from the level above (src/holographic/column.c). Groups are counted by cone, pair of columns and
// window of blocks; blocks whose segments are clear are worked off first, without them.
//
// A pair is an even column 2q, which the level above has too, and the odd one behind it. Both end at the next column of
// the level above: from row y of the even column and from row y + rise of the odd one a segment ends at the same place.

override HAS_EVEN: bool = true; // false for the first pair: nobody asks for column 0
override HAS_BEYOND: bool = true; // false for the last one: it ends where the world does

@group(0) @binding(1) var own: texture_2d<f32>; // T of the quadrant's level: [column][ray][row]
@group(0) @binding(2) var longer: texture_2d<f32>; // of the level above
@group(0) @binding(4) var radiance: texture_storage_2d<rgba32float, write>; // R of the quadrant's level: [column][cone][row]

struct Cone {
    end: Column,
    here: Column, // the even column, in the level above
    length: i32,
    rise: i32,
    weight: vec2f,
    odd_segment: f32, // places of the low rays
    even_segment: f32,
    odd_texel: vec2f,
    even_texel: vec2f,
    odd_out: i32, // rows
    even_out: i32,
    is_odd_there: bool,
}

fn cone_of(i: i32, q: i32) -> Cone {
    let reach = quadrant.reach;
    let odd_texel = texel_of(own);
    let even_texel = texel_of(longer);
    return Cone(column_of(2 * reach, q + 1, 2 * i), column_of(2 * reach, q, 2 * i), quadrant.length, 2 * i - reach,
                weights[reach + i], middle_of(PLANES * row_of(reach, 2 * q + 1, i), odd_texel.y),
                middle_of(PLANES * row_of(2 * reach, q, 2 * i), even_texel.y), odd_texel, even_texel,
                cone_row_of(reach, 2 * q + 1, i), cone_row_of(reach, 2 * q, i), 2 * q + 1 < quadrant.columns);
}

fn light_at_end(cone: Cone, of_cone: f32, y: i32) -> vec3f {
    if (HAS_BEYOND) {
        return light_beyond(cone.end, of_cone, y);
    }
    return cone.end.sky;
}

// What the two rays of a cone meet.
struct Pair {
    low: Interval,
    high: Interval,
}

// A row of the even column and what belongs to it of the odd one, whose high ray ends at `high_odd`. Returns the light
// where the high ray of the even one ends: there that of the odd column's next row ends, too.
fn merge_row(cone: Cone, y: i32, high_odd: vec3f, odd: Pair, even: Pair) -> vec3f {
    let odd_y = y + cone.rise;
    let low = light_at_end(cone, cone.end.low, odd_y + cone.rise);
    let high = light_at_end(cone, cone.end.high, odd_y + cone.rise + 4);
    let odd_light = weighed(cone.weight.x, odd.low, through(odd.low, low)) +
                    weighed(cone.weight.y, odd.high, through(odd.high, high_odd));
    textureStore(radiance, vec2i(kept_at(odd_y, cone.is_odd_there), cone.odd_out), vec4f(odd_light, 0.0));
    if (HAS_EVEN) {
        let half = 0.5 * cone.weight;
        let beyond_low = through(even.low, low) + light_at(cone.here, cone.here.low, y);
        let beyond_high = through(even.high, high) + light_at(cone.here, cone.here.high, y);
        let even_light = weighed(half.x, even.low, beyond_low) + weighed(half.y, even.high, beyond_high);
        textureStore(radiance, vec2i(kept_at(y, true), cone.even_out), vec4f(even_light, 0.0));
    }
    return high;
}

fn high_odd_of(cone: Cone, y: i32) -> vec3f {
    return light_at_end(cone, cone.end.high, y + 2 * cone.rise + 2);
}

struct Masks {
    odd_low: Shifted,
    odd_high: Shifted,
    even_low: Window,
    even_high: Window,
}

fn masks_of(i: i32, q: i32, first: i32, cone: Cone) -> Masks {
    let odd = quadrant.rows + row_of(quadrant.reach, 2 * q + 1, i);
    let even = quadrant.rows_above + row_of(2 * quadrant.reach, q, 2 * i);
    return Masks(shifted_of(odd, first, cone.rise, cone.is_odd_there),
                 shifted_of(odd + 1, first, cone.rise, cone.is_odd_there),
                 window_of(even, first, HAS_EVEN), window_of(even + 2, first, HAS_EVEN));
}

fn odd_pair(cone: Cone, masks: Masks, block: Window, begin: i32, row: i32) -> Pair {
    let low = vec2f(middle_of(begin + row + cone.rise, cone.odd_texel.x), cone.odd_segment);
    let high = vec2f(low.x, low.y + f32(PLANES) * cone.odd_texel.y);
    return Pair(choose(nothing(), interval_at(own, low, cone.odd_texel), sees(masks.odd_low, block, row)),
                choose(nothing(), interval_at(own, high, cone.odd_texel), sees(masks.odd_high, block, row)));
}

fn even_pair(cone: Cone, masks: Masks, block: Window, y: i32) -> Pair {
    let low = vec2f(middle_of(y, cone.even_texel.x), cone.even_segment);
    let high = vec2f(low.x, low.y + f32(2 * PLANES) * cone.even_texel.y);
    return Pair(choose(nothing(), interval_at(longer, low, cone.even_texel), has(masks.even_low, block)),
                choose(nothing(), interval_at(longer, high, cone.even_texel), has(masks.even_high, block)));
}

fn merge_seen(cone: Cone, masks: Masks, block: Window, begin: i32, row: i32, high_odd: vec3f) -> vec3f {
    let y = begin + row;
    return merge_row(cone, y, high_odd, odd_pair(cone, masks, block, begin, row), even_pair(cone, masks, block, y));
}

@compute @workgroup_size(LANES)
fn merge(@builtin(local_invocation_index) lane: u32, @builtin(workgroup_id) id: vec3u) {
    let q = quadrant.first + i32(id.y);
    let cone = cone_of(i32(id.x), q);
    // Rows of the odd column may lie before or behind those of the even one.
    let begin = min(0, -cone.rise >> 4u);
    let end = max(count_of_blocks(), ((cone.length - 1 - cone.rise) >> 4u) + 1);
    let first = begin + i32(id.z) * WINDOW;
    let masks = masks_of(i32(id.x), q, first, cone);
    let found = all_of(masks.odd_low) | all_of(masks.odd_high) | masks.even_low | masks.even_high;
    let row = first_row(lane);
    let clear = Pair(nothing(), nothing());

    var left = some_of(window_to(end - first) & ~found);
    loop {
        let block = lowest(left);
        let y = (first + number_of(block)) * BLOCK + row;
        var high = high_odd_of(cone, y);
        var i = 0;
        loop {
            high = merge_row(cone, y + i, high, clear, clear);
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
    left = some_of(found);
    loop {
        let block = lowest(left);
        let begin = (first + number_of(block)) * BLOCK;
        var high = high_odd_of(cone, begin + row);
        var i = 0;
        loop {
            high = merge_seen(cone, masks, block, begin, row + i, high);
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
}
