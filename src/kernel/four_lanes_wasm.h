/* What vectors of four lanes need of WebAssembly's simd128. Included by simd.h alone, behind its types;
 * four_lanes_sse2.h is the same for x86-64. */
#ifndef DPL_KERNEL_FOUR_LANES_WASM_H
#define DPL_KERNEL_FOUR_LANES_WASM_H

#include <wasm_simd128.h>

/* Is any lane of a mask set? */
static inline bool four_lanes_any(vint mask) {
    return wasm_v128_any_true((v128_t)mask);
}

/* Bit i: lane i of a mask. */
static inline uint32_t four_lanes_bits(vint mask) {
    return wasm_i32x4_bitmask((v128_t)mask);
}

static inline vfloat four_lanes_square_root(vfloat v) {
    return (vfloat)wasm_f32x4_sqrt((v128_t)v);
}

/* Downwards; anything where the result is no 32-bit number. */
static inline vint four_lanes_floor(vfloat v) {
    return (vint)wasm_i32x4_trunc_sat_f32x4(wasm_f32x4_floor((v128_t)v));
}

/* a < b ? a : b, so b where one is not a number. */
static inline vfloat four_lanes_least(vfloat a, vfloat b) {
    return (vfloat)wasm_f32x4_pmin((v128_t)b, (v128_t)a);
}

/* a > b ? a : b, so b where one is not a number. */
static inline vfloat four_lanes_greatest(vfloat a, vfloat b) {
    return (vfloat)wasm_f32x4_pmax((v128_t)b, (v128_t)a);
}

/* Four bytes from memory. */
static inline vint four_lanes_load_bytes(const uint8_t *from) {
    v128_t words = wasm_u16x8_extend_low_u8x16(wasm_v128_load32_zero(from));
    return (vint)wasm_u32x4_extend_low_u16x8(words);
}

/* Four 16-bit numbers from memory, never negative. */
static inline vint four_lanes_load_u16(const uint16_t *from) {
    return (vint)wasm_u32x4_load16x4(from);
}

/* Lanes within -32768 .. 32767 to memory. */
static inline void four_lanes_store_i16(uint16_t *to, vint v) {
    v128_t packed = wasm_i16x8_narrow_i32x4((v128_t)v, (v128_t)v);
    wasm_v128_store64_lane(to, packed, 0);
}

static inline void four_lanes_store_bytes(uint8_t *to, vint v) {
    v128_t words = wasm_i16x8_narrow_i32x4((v128_t)v, (v128_t)v);
    wasm_v128_store32_lane(to, wasm_u8x16_narrow_i16x8(words, words), 0);
}

#endif
