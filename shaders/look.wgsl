// Light from near: what a pixel beside lamps receives straight from opaque pixels a few pixels away, as the truth finds
// it (src/holographic/rims.c: dpl_hrc_light_near). rims.wgsl takes it off before its filter and puts it back after.

// Near is what is at most so many rows and columns away.
const NEAR: i32 = 7;
const SIDE: i32 = 2 * NEAR + 1;
const MIDDLE: u32 = u32(NEAR);
const DIRECTIONS: f32 = 120.0;
const RADIANCE_MAX: f32 = 1e37;

@group(0) @binding(2) var<storage, read> sights: array<vec4u>; // [dy][dx]: directions, a bit each
@group(0) @binding(5) var<storage, read> sets: array<Bits>; // as mark.wgsl leaves them
@group(0) @binding(7) var<storage, read_write> near: array<vec4f>; // see below
@group(0) @binding(8) var<storage, read> count: u32;
@group(0) @binding(9) var<storage, read> listed: array<u32>; // as list.wgsl leaves it

struct Looker {
    x: i32,
    y: i32,
    open: vec4u, // directions in which nothing was met so far
    light: vec4f, // and in w the share of directions that it comes from
    some: u32, // columns of lamps in any row
    all: u32, // columns of lamps in all rows that have some
}

fn bits_at(word: i32, y: i32) -> Bits {
    let words = i32(words_of_row());
    let is_inside = (u32(word) < u32(words)) & (u32(y) < picture.size.y); // no &&: it is a branch
    let found = sets[y * words + word];
    return Bits(select(0u, found.opaque, is_inside), select(0u, found.lamps, is_inside));
}

fn window(first: u32, last: u32, shift: u32) -> u32 {
    return ((first >> shift) | ((last << 1u) << (31u - shift))) & ((1u << u32(SIDE)) - 1u);
}

// Pixels near of the row that is dy away: bit NEAR stands for the looker's column.
fn row_near(looker: Looker, dy: i32) -> Bits {
    let first_column = looker.x - NEAR + i32(WORD);
    let word = first_column / i32(WORD) - 1;
    let shift = u32(first_column) % WORD;
    let first = bits_at(word, looker.y + dy);
    let last = bits_at(word + 1, looker.y + dy);
    return Bits(window(first.opaque, last.opaque, shift), window(first.lamps, last.lamps, shift));
}

// What is behind an opaque pixel is not seen any more.
fn meet(looker: ptr<function, Looker>, bit: u32, dy: i32) {
    let dx = i32(bit) - NEAR;
    let seen = sights[(dy + NEAR) * SIDE + dx + NEAR] & (*looker).open;
    (*looker).open ^= seen;
    let counts = countOneBits(seen);
    let share = f32(counts.x + counts.y + counts.z + counts.w) / DIRECTIONS;
    let shown = emission[((*looker).y + dy) * i32(picture.size.x) + (*looker).x + dx].rgb;
    (*looker).light += share * vec4f(min(shown, vec3f(RADIANCE_MAX)), f32(any(shown > vec3f(0.0))));
}

// Pixels of a row from the looker's column outwards, for what is nearer hides what is further.
fn meet_row(looker: ptr<function, Looker>, dy: i32, row: u32) {
    for (var right = row >> MIDDLE; right != 0u; right &= right - 1u) {
        meet(looker, MIDDLE + firstTrailingBit(right), dy);
    }
    for (var left = row & ((1u << MIDDLE) - 1u); left != 0u;) {
        let last = firstLeadingBit(left);
        meet(looker, last, dy);
        left ^= 1u << last;
    }
}

// The columns from the looker's to those of lamps: only what is there can hide them.
fn columns_to(lamps: u32) -> u32 {
    let all = lamps | (1u << MIDDLE);
    return (2u << firstLeadingBit(all)) - (1u << firstTrailingBit(all));
}

// What of a row is not hidden whole: a pixel with opaque ones before it, in its row and in the row before, can only be
// seen through these.
fn uncovered(row: u32, row_before: u32) -> u32 {
    let middle = 1u << MIDDLE;
    let left = middle - 1u;
    let right = left << (MIDDLE + 1u);
    let has_before = ((row << 1u) & right) | ((row >> 1u) & left) | middle;
    return row & ~(has_before & row_before);
}

// The looker's row and those above it (way -1) or below it (1), outwards, up to the last that has lamps.
fn look_along(looker: ptr<function, Looker>, way: i32) {
    var rows: array<Bits, NEAR + 1>;
    for (var reach = 0; reach <= NEAR; reach++) {
        rows[reach] = row_near(*looker, way * reach);
        let lamps = rows[reach].lamps;
        (*looker).some |= lamps;
        (*looker).all &= select(lamps, 0xffffffffu, lamps == 0u);
    }
    for (var reach = NEAR - 1; reach >= 0; reach--) {
        rows[reach].lamps |= rows[reach + 1].lamps; // of a row and of all further ones
    }
    var before = 0xffffffffu;
    for (var reach = 0; reach <= NEAR && rows[reach].lamps != 0u; reach++) {
        let row = rows[reach].opaque;
        meet_row(looker, way * reach, uncovered(row, before) & columns_to(rows[reach].lamps));
        before = row;
    }
}

// Do the sums show lamps near as they are? So they do where the looker touches one, and where all are one box along the
// axes, whose sides have no stairs.
fn is_shown_right(looker: Looker) -> bool {
    let middle = 1u << MIDDLE;
    let sides = (middle << 1u) | (middle >> 1u);
    let own = row_near(looker, 0).lamps & sides;
    let touched = own | ((row_near(looker, -1).lamps | row_near(looker, 1).lamps) & middle);
    return (touched != 0u) | (looker.some == looker.all);
}

// Leaves the light, and the share of directions that it comes from, negative where the sums show lamps as they are.
@compute @workgroup_size(GROUP)
fn look(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u,
        @builtin(local_invocation_index) local: u32) {
    for (var i = item_of(group, groups, local); i < count; i += groups.x * groups.y * GROUP) {
        let pixel = listed[i] & ~ON_RIM;
        let y = pixel / picture.size.x;
        var looker = Looker(i32(pixel - y * picture.size.x), i32(y), vec4u(0xffffffffu), vec4f(0.0), 0u, 0xffffffffu);
        look_along(&looker, 1);
        look_along(&looker, -1);
        let sign = select(1.0, -1.0, is_shown_right(looker));
        near[pixel] = looker.light * vec4f(1.0, 1.0, 1.0, sign);
    }
}
