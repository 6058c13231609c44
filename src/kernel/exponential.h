/* exp(-x) from + - * and bits alone, so that every compiler and instruction set gives the same bytes.
 * Relative error below 2e-7 for x in [0, 87]; 0 beyond. Used by kernels that cross media. */
#ifndef DPL_KERNEL_EXPONENTIAL_H
#define DPL_KERNEL_EXPONENTIAL_H

#include <stdint.h>
#include <string.h>

static inline float dpl_exp_negative(float x) {
    if (!(x < 87.0f))
        return 0.0f;
    /* x = n ln2 + r with |r| <= ln2/2; exp(-x) = 2^-n exp(-r) */
    float n = (float)(int32_t)(x * 1.44269504f + 0.5f);
    float r = (x - n * 0.693359375f) + n * 2.12194440e-4f;
    float p = 1.0f / 720.0f;
    p = 1.0f / 120.0f - r * p;
    p = 1.0f / 24.0f - r * p;
    p = 1.0f / 6.0f - r * p;
    p = 0.5f - r * p;
    p = 1.0f - r * p;
    p = 1.0f - r * p;
    uint32_t bits = (uint32_t)(127 - (int32_t)n) << 23;
    float scale;
    memcpy(&scale, &bits, sizeof scale);
    return p * scale;
}

#endif
