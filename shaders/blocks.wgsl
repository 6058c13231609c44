// Which blocks of a row of T hold anything: a bit each, as the masks of src/holographic/column.c. T is neither computed
// nor loaded where they are clear. Part of the kernels that write or read T.

@group(0) @binding(8) var<storage, read> blocks: array<u32>; // [row][word]

// The blocks of a word that the quadrant has.
fn blocks_in(word: i32) -> u32 {
    let count = min((quadrant.length + BLOCK - 1) / BLOCK - word * WORD, WORD);
    return 0xffffffffu >> u32(WORD - count);
}

fn word_of(row: i32, word: i32) -> u32 {
    return select(0u, blocks[row * quadrant.words + word], u32(word) < u32(quadrant.words));
}

// 32 blocks of a row from the one of this number, which may lie outside.
fn blocks_from(row: i32, first: i32) -> u32 {
    let word = first >> 5u;
    let shift = u32(first & 31);
    return (word_of(row, word) >> shift) | ((word_of(row, word + 1) << 1u) << (31u - shift));
}

// What is seen of a row from a word whose values are `rise` rows before it.
struct Seen {
    all: u32, // blocks from which some invocation sees what is not clear
    mine: u32, // and this one
}

fn seen_from(row: i32, word: i32, rise: i32, lane: i32, is_there: bool) -> Seen {
    let first = word * WORD + (rise >> 4u);
    let offset = rise & (BLOCK - 1);
    let low = select(0u, blocks_from(row, first), is_there);
    let high = select(0u, blocks_from(row, first + 1), is_there & (offset != 0));
    return Seen(low | high, select(low, high, lane + offset >= BLOCK));
}

// A group's way through blocks, lowest first:
//     var left = some_of(…);
//     loop { let y = row_in(word, left, lane); …; continuing { left &= left - 1u; break if left == 0u; } }
// A software adapter skips nothing else: a loop that is asked at its end takes as many rounds as there are blocks, one
// that is asked at its beginning takes one more.

// The blocks to work off: block 0 where there is none, which does no harm.
fn some_of(wanted: u32) -> u32 {
    return max(wanted, 1u);
}

fn lowest(left: u32) -> u32 {
    return left & (~left + 1u);
}

// The row of the lowest block that falls to an invocation. From the exponent of a float: firstTrailingBit() takes a
// software adapter as long as a dozen loads.
fn row_in(word: i32, left: u32, lane: i32) -> i32 {
    let exponent = (bitcast<i32>(f32(bitcast<i32>(lowest(left)))) >> 23u) & 255;
    return (word * WORD + exponent - 127) * BLOCK + lane;
}
