/* sRGB bytes from linear light, exactly rounded, by two look-ups and a comparison: the table, and the scalar
 * reference of the kernel. Filled in by srgb.c.
 *
 * Code k begins at decode((k - 1/2) / 255). The floats of [2^-13, 1] are cut into 128 steps per octave, so
 * narrow that in none of them more than one code begins: a step knows the code at its start and where the
 * next one begins. Below 2^-13 the code is 0. */
#ifndef DPL_KERNEL_SRGB_H
#define DPL_KERNEL_SRGB_H

#include <stdint.h>
#include <string.h>

#define SRGB_LOWEST 0x1p-13f
#define SRGB_LOWEST_BITS 0x39000000
#define SRGB_STEP_SHIFT 16 /* bits of a float's mantissa that are left below a step */
#define SRGB_STEPS (13 * 128 + 1)

typedef struct dpl_srgb_steps {
    float code[SRGB_STEPS]; /* 0 .. 255 */
    float next[SRGB_STEPS]; /* where code + 1 begins */
} dpl_srgb_steps;

void dpl_srgb_steps_fill(dpl_srgb_steps *steps);

/* sRGB (IEC 61966-2-1) to linear light; values outside 0 .. 1 continue the curve. */
double dpl_srgb_decode(double encoded);

static inline uint8_t dpl_srgb_encode(const dpl_srgb_steps *steps, float linear) {
    float v = linear > SRGB_LOWEST ? linear : SRGB_LOWEST; /* also for not-a-number */
    v = v < 1.0f ? v : 1.0f;
    int32_t bits;
    memcpy(&bits, &v, sizeof bits);
    int32_t step = (bits - SRGB_LOWEST_BITS) >> SRGB_STEP_SHIFT;
    return (uint8_t)((int32_t)steps->code[step] + (v >= steps->next[step]));
}

#endif
