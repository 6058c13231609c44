// Which blocks of a row of T hold anything: a bit each, as the masks of src/holographic/column.c. T is neither computed
// nor loaded where they are clear. Part of the kernels that write or read T.

// Up to 64 blocks of a row from any one on, which may lie outside; the first is bit 0 of x.
alias Window = vec2u;

const WINDOW: i32 = 64;

@group(0) @binding(8) var<storage, read_write> blocks: array<atomic<u32>>; // [row of any level][word]

fn word_of(row: i32, word: i32) -> u32 {
    return select(0u, atomicLoad(&blocks[row * quadrant.words + word]), u32(word) < u32(quadrant.words));
}

fn window_of(row: i32, first: i32, is_there: bool) -> Window {
    let word = first >> 5u;
    let shift = u32(first & 31);
    let found = vec3u(word_of(row, word), word_of(row, word + 1), word_of(row, word + 2));
    let window = (found.xy >> vec2u(shift)) | ((found.yz << vec2u(1u)) << vec2u(31u - shift));
    return select(Window(0u), window, is_there);
}

// Adds what an invocation found to a window that begins with a word.
fn keep_window(row: i32, first: i32, found: Window) {
    let at = row * quadrant.words + (first >> 5u);
    if (found.x != 0u) {
        atomicOr(&blocks[at], found.x);
    }
    if (found.y != 0u) {
        atomicOr(&blocks[at + 1], found.y);
    }
}

fn ones(count: i32) -> u32 {
    return select(0xffffffffu >> u32(clamp(32 - count, 0, 31)), 0u, count <= 0);
}

// The first so many blocks.
fn window_to(count: i32) -> Window {
    return Window(ones(count), ones(count - 32));
}

fn count_of_blocks() -> i32 {
    return (quadrant.length + BLOCK - 1) / BLOCK;
}

fn is_any(window: Window) -> bool {
    return (window.x | window.y) != 0u;
}

fn has(window: Window, block: Window) -> bool {
    return is_any(window & block);
}

// A group's way through blocks, lowest first:
//     var left = some_of(…);
//     loop { let block = lowest(left); …; continuing { left ^= block; break if !is_any(left); } }
// A software adapter skips nothing else: a loop that is asked at its end takes as many rounds as there are blocks, one
// that is asked at its beginning takes one more.

// The blocks to work off: the first where there is none, which does no harm.
fn some_of(wanted: Window) -> Window {
    return select(wanted, Window(1u, 0u), !is_any(wanted));
}

fn lowest(left: Window) -> Window {
    let low = left & (~left + 1u);
    return Window(low.x, select(low.y, 0u, low.x != 0u));
}

// The number of a block, which is the only one set. From the exponent of a float: firstTrailingBit() takes a software
// adapter as long as a dozen loads.
fn number_of(block: Window) -> i32 {
    let exponent = (bitcast<i32>(f32(bitcast<i32>(block.x | block.y))) >> 23u) & 255;
    return exponent - 127 + select(0, 32, block.x == 0u);
}

// What a block sees of a row whose values are `rise` rows after it: of two blocks that follow each other.
struct Shifted {
    low: Window,
    high: Window,
    offset: i32, // from a value of the block to where it is in those two
}

fn shifted_of(row: i32, first: i32, rise: i32, is_there: bool) -> Shifted {
    let from_block = first + (rise >> 4u);
    let low = window_of(row, from_block, is_there);
    let high = window_of(row, from_block + 1, is_there);
    return Shifted(low, high, rise & (BLOCK - 1));
}

// Blocks that see something that is not clear.
fn all_of(seen: Shifted) -> Window {
    return seen.low | select(Window(0u), seen.high, seen.offset != 0);
}

// Does this row of the block?
fn sees(seen: Shifted, block: Window, row: i32) -> bool {
    return select(has(seen.low, block), has(seen.high, block), row + seen.offset >= BLOCK);
}
