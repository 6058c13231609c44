/* Counting and finding bits, which the language lacks. Included by whoever keeps sets as bits. */
#ifndef DPL_KERNEL_BITS_H
#define DPL_KERNEL_BITS_H

#include <stdint.h>

static inline int32_t dpl_bit_count(uint64_t bits) {
#if defined(__wasm__) /* which has an instruction for it */
    return __builtin_popcountll(bits);
#else
    bits -= bits >> 1 & 0x5555555555555555u;
    bits = (bits & 0x3333333333333333u) + (bits >> 2 & 0x3333333333333333u);
    bits = (bits + (bits >> 4)) & 0x0f0f0f0f0f0f0f0fu;
    return (int32_t)(bits * 0x0101010101010101u >> 56);
#endif
}

/* Number of the lowest bit that is set; `bits` is not 0. */
static inline int32_t dpl_bit_lowest(uint64_t bits) {
#if defined(__GNUC__)
    return __builtin_ctzll(bits);
#else
    return dpl_bit_count((bits & (0 - bits)) - 1);
#endif
}

/* Number of the highest bit that is set; `bits` is not 0. */
static inline int32_t dpl_bit_highest(uint64_t bits) {
#if defined(__GNUC__)
    return 63 - __builtin_clzll(bits);
#else
    for (int32_t reach = 1; reach < 64; reach *= 2)
        bits |= bits >> reach;
    return dpl_bit_count(bits) - 1;
#endif
}

#endif
