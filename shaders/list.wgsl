// Lists the free pixels beside lamps, which look.wgsl and rims.wgsl go through, in any order.

// How far from a lamp [rows and columns]: those of a rim, and those whose near light the filter of a rim reads.
const RIM: i32 = 2;
const BESIDE: i32 = RIM + 1;

@group(0) @binding(5) var<storage, read> sets: array<Bits>; // as mark.wgsl leaves them
@group(0) @binding(8) var<storage, read_write> count: atomic<u32>;
@group(0) @binding(9) var<storage, read_write> listed: array<u32>; // pixels; ON_RIM is added to those of a rim

// The lamps of a word, in rows y - reach to y + reach together.
fn lamps_beside(word: i32, y: i32, reach: i32) -> u32 {
    let words = i32(words_of_row());
    if (word < 0 || word >= words) {
        return 0u;
    }
    var lamps = 0u;
    for (var row = max(y - reach, 0); row <= min(y + reach, i32(picture.size.y) - 1); row++) {
        lamps |= sets[row * words + word].lamps;
    }
    return lamps;
}

// The pixels of a word that have a lamp at most `reach` rows and columns away.
fn beside_lamps(word: i32, y: i32, reach: i32) -> u32 {
    let left = lamps_beside(word - 1, y, reach);
    let here = lamps_beside(word, y, reach);
    let right = lamps_beside(word + 1, y, reach);
    var found = here;
    for (var step = 1u; step <= u32(reach); step++) {
        found |= (here << step) | (here >> step) | (left >> (WORD - step)) | (right << (WORD - step));
    }
    return found;
}

// An item is a word.
@compute @workgroup_size(GROUP)
fn list(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u,
        @builtin(local_invocation_index) local: u32) {
    let item = item_of(group, groups, local);
    if (item >= words_of_row() * picture.size.y) {
        return;
    }
    let y = item / words_of_row();
    let word = item - y * words_of_row();
    let left = picture.size.x - word * WORD; // pixels of the row from here on
    let inside = select(0xffffffffu, (1u << left) - 1u, left < WORD);
    var rest = beside_lamps(i32(word), i32(y), BESIDE) & inside & ~sets[item].opaque;
    if (rest == 0u) {
        return;
    }
    let on_rim = beside_lamps(i32(word), i32(y), RIM);
    var at = atomicAdd(&count, countOneBits(rest));
    for (; rest != 0u; rest &= rest - 1u) {
        let bit = firstTrailingBit(rest);
        listed[at] = (y * picture.size.x + word * WORD + bit) | select(0u, ON_RIM, (on_rim & (1u << bit)) != 0u);
        at++;
    }
}
