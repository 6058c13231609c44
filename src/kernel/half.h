/* IEEE half precision in 16 bits, by integer operations on the bits of a float: the scalar reference of the
 * conversions in simd.h. Used by ref.c, and where single values are read or written.
 *
 * A half here carries light: what no half can hold becomes the nearest that it can, never infinity. */
#ifndef DPL_KERNEL_HALF_H
#define DPL_KERNEL_HALF_H

#include <stdint.h>
#include <string.h>

/* The largest finite half. */
#define HALF_MAX 65504.0f

/* Bits of floats: HALF_MAX, the smallest normal half 2^-14, and the difference of the exponents' biases. */
#define HALF_MAX_BITS 0x477fe000
#define HALF_NORMAL_BITS 0x38800000
#define HALF_BIAS_BITS (112 << 23)

/* `bits` is that of a positive float below 2^-14: how often 2^-24 goes into it, ties to even. */
static inline uint32_t dpl_half_subnormal(uint32_t bits) {
    uint32_t exponent = bits >> 23;
    if (exponent < 102)
        return 0; /* below 2^-25, half of the smallest */
    uint32_t mantissa = (bits & 0x7fffff) | 0x800000, shift = 126 - exponent;
    uint32_t half = mantissa >> shift, rest = mantissa & ((1u << shift) - 1), tie = 1u << (shift - 1);
    return half + (rest > tie || (rest == tie && half % 2 == 1));
}

/* Rounds to nearest, ties to even; beyond +-65504 becomes that; not-a-number becomes 0. */
static inline uint16_t dpl_half_from_float(float value) {
    uint32_t bits;
    memcpy(&bits, &value, sizeof bits);
    uint32_t sign = bits >> 16 & 0x8000, magnitude = bits & 0x7fffffff;
    if (magnitude > 0x7f800000)
        return 0;
    if (magnitude > HALF_MAX_BITS)
        magnitude = HALF_MAX_BITS;
    if (magnitude < HALF_NORMAL_BITS)
        return (uint16_t)(sign | dpl_half_subnormal(magnitude));
    uint32_t rounded = magnitude + 0xfff + (magnitude >> 13 & 1);
    return (uint16_t)(sign | (rounded - HALF_BIAS_BITS) >> 13);
}

/* Exact. Infinity stays; not-a-number stays, made quiet as processors do. */
static inline float dpl_float_from_half(uint16_t half) {
    uint32_t sign = (half & 0x8000u) << 16, magnitude = half & 0x7fffu, bits;
    if (magnitude < 0x400) { /* subnormal: a float holds it as a normal number */
        float value = (float)magnitude * 0x1p-24f;
        memcpy(&bits, &value, sizeof bits);
    } else if (magnitude < 0x7c00)
        bits = (magnitude << 13) + HALF_BIAS_BITS;
    else
        bits = (magnitude << 13) | 0x7f800000u | (magnitude > 0x7c00 ? 0x400000u : 0u);
    bits |= sign;
    float value;
    memcpy(&value, &bits, sizeof value);
    return value;
}

#endif
