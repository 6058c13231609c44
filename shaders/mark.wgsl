// Which pixels are opaque, and which of those are lamps (src/holographic/rims.c: dpl_hrc_mark_sets).

@group(0) @binding(5) var<storage, read_write> sets: array<Bits>; // [y][word]
// [y][word]: a bit for each four pixels, set where any is not empty
@group(0) @binding(6) var<storage, read> occupied: array<u32>;

fn bits_of(row: u32, first: u32, behind: u32) -> Bits {
    var bits = Bits(0u, 0u);
    for (var x = first; x < behind; x++) {
        let here = emission[row + x];
        let bit = select(0u, 1u << (x - first), here.w == OPAQUE);
        bits.opaque |= bit;
        bits.lamps |= select(0u, bit, any(here.rgb > vec3f(0.0)));
    }
    return bits;
}

// The 32 pixels of a word have eight bits of those.
fn is_empty(y: u32, word: u32) -> bool {
    let words = arrayLength(&occupied) / picture.size.y;
    return extractBits(occupied[y * words + word / 4u], 8u * (word % 4u), 8u) == 0u;
}

// An item is a word. Most have nothing in them.
@compute @workgroup_size(GROUP)
fn mark(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u,
        @builtin(local_invocation_index) local: u32) {
    let item = item_of(group, groups, local);
    if (item >= words_of_row() * picture.size.y) {
        return;
    }
    let y = item / words_of_row();
    let row = y * picture.size.x;
    let word = item - y * words_of_row();
    let first = word * WORD;
    let behind = min(first + WORD, picture.size.x);
    sets[item] = bits_of(row, first, select(behind, first, is_empty(y, word)));
}
