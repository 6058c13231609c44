// What a list of pixels is made of. Part of list.wgsl, look.wgsl and rims.wgsl.

const ON_RIM: u32 = 1u << 31u; // more than the number of any pixel
