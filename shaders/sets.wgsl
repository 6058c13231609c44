// Sets of pixels, a bit each: what is opaque, and of that the lamps. Part of mark.wgsl, list.wgsl and look.wgsl.

const WORD: u32 = 32u;

struct Bits {
    opaque: u32,
    lamps: u32,
}

fn words_of_row() -> u32 {
    return (picture.size.x + WORD - 1u) / WORD;
}
