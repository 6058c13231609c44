// The two steps that holographic radiance cascades are made of (src/holographic/column.c): segments of twice the
// length, and radiance merged from the level above. Groups are counted by ray or cone, and column.
//
// Everything is loaded from where it would be, and replaced where that is outside the world: a software adapter
// computes both sides of a branch anyway.

@group(0) @binding(1) var<storage, read> own: array<Interval>; // T of the quadrant's level: [column][ray][row]
@group(0) @binding(2) var<storage, read_write> longer: array<Interval>; // extend: T of the level above
@group(0) @binding(3) var<storage, read> across: array<Interval>; // merge: the same
@group(0) @binding(4) var<storage, read_write> radiance: array<vec3f>; // R of the quadrant's level: [column][cone][row]

// Rays 2k and 2k+1 of the level above from rays k and k+1, which are half as long. Beyond the world there is nothing.
@compute @workgroup_size(GROUP)
fn extend(@builtin(local_invocation_index) first: u32, @builtin(workgroup_id) id: vec3u) {
    let k = i32(id.x);
    let p = i32(id.y) + 1;
    let rows = rows_of(2 * p + 1, quadrant.columns);
    let here = segment_at(quadrant.reach, 2 * p, k);
    let there = segment_at(quadrant.reach, 2 * p + 1, k);
    let out = segment_at(2 * quadrant.reach, p, 2 * k);
    for (var y = i32(first); y < quadrant.length; y += ROW_STEP) {
        let end = y + 2 * k - quadrant.reach;
        let near = own[here + y];
        let far = choose(nothing(), own[there + end], u32(end) < rows);
        longer[out + y] = compose(near, far);
        let low = compose(near, choose(nothing(), own[there + quadrant.length + end], u32(end) < rows));
        let beyond = choose(nothing(), own[there + end + 2], u32(end + 2) < rows);
        let high = compose(own[here + quadrant.length + y], beyond);
        if (k < quadrant.reach) {
            longer[out + quadrant.length + y] = mean_of(low, high);
        }
    }
}

// A cone of an odd column: what its two rays bring, and behind them the next column of the level above.
@compute @workgroup_size(GROUP)
fn merge_odd(@builtin(local_invocation_index) first: u32, @builtin(workgroup_id) id: vec3u) {
    let i = i32(id.x);
    let q = i32(id.y); // column of the level above that begins here
    let rows = rows_of(q + 1, quadrant.columns_above);
    let segment = segment_at(quadrant.reach, 2 * q + 1, i);
    let there = cone_at(2 * quadrant.reach, q + 1, 2 * i);
    let out = cone_at(quadrant.reach, 2 * q + 1, i);
    let weight = weights[quadrant.reach + i];
    for (var y = i32(first); y < quadrant.length; y += ROW_STEP) {
        let end = y + 2 * i - quadrant.reach;
        let low = own[segment + y];
        let high = own[segment + quadrant.length + y];
        let beyond_low = through(low, light_above(there, end, rows));
        let beyond_high = through(high, light_above(there + quadrant.length, end + 2, rows));
        radiance[out + y] = weighed(weight.x, low, beyond_low) + weighed(weight.y, high, beyond_high);
    }
}

// A cone of an even column, which the level above has too: half of it from here, half from the end of its segments.
@compute @workgroup_size(GROUP)
fn merge_even(@builtin(local_invocation_index) first: u32, @builtin(workgroup_id) id: vec3u) {
    let i = i32(id.x);
    let q = i32(id.y) + 1; // of the level above
    let rows = rows_of(q + 1, quadrant.columns_above);
    let segment = segment_at(2 * quadrant.reach, q, 2 * i);
    let here = cone_at(2 * quadrant.reach, q, 2 * i);
    let there = cone_at(2 * quadrant.reach, q + 1, 2 * i);
    let out = cone_at(quadrant.reach, 2 * q, i);
    let weight = 0.5 * weights[quadrant.reach + i];
    for (var y = i32(first); y < quadrant.length; y += ROW_STEP) {
        let end = y + 2 * (2 * i - quadrant.reach);
        let low = across[segment + y];
        let high = across[segment + 2 * quadrant.length + y];
        let beyond_low = through(low, light_above(there, end, rows)) + above[here + y];
        let beyond_high = through(high, light_above(there + quadrant.length, end + 4, rows)) +
                          above[here + quadrant.length + y];
        radiance[out + y] = weighed(weight.x, low, beyond_low) + weighed(weight.y, high, beyond_high);
    }
}
