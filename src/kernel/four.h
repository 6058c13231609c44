/* Four floats side by side: one instruction each where SSE2 is the baseline (every x86-64), loops elsewhere,
 * with the same results bit for bit. Inlined into walks through hierarchies, where a call per node would cost
 * more than the work; longer loops belong behind the kernel table. */
#ifndef DPL_KERNEL_FOUR_H
#define DPL_KERNEL_FOUR_H

#include <stdint.h>

#if defined(__SSE2__)

#include <emmintrin.h>

typedef __m128 dpl_four;

static inline dpl_four dpl_four_all(float v) {
    return _mm_set1_ps(v);
}

/* `from` is aligned to 16 bytes, as is `to`. */
static inline dpl_four dpl_four_load(const float *from) {
    return _mm_load_ps(from);
}

static inline void dpl_four_store(float *to, dpl_four v) {
    _mm_store_ps(to, v);
}

static inline dpl_four dpl_four_subtract(dpl_four a, dpl_four b) {
    return _mm_sub_ps(a, b);
}

static inline dpl_four dpl_four_multiply(dpl_four a, dpl_four b) {
    return _mm_mul_ps(a, b);
}

/* b where they are equal or not numbers. */
static inline dpl_four dpl_four_least(dpl_four a, dpl_four b) {
    return _mm_min_ps(a, b);
}

static inline dpl_four dpl_four_most(dpl_four a, dpl_four b) {
    return _mm_max_ps(a, b);
}

/* Bit i: a[i] <= b[i]. */
static inline uint32_t dpl_four_ordered(dpl_four a, dpl_four b) {
    return (uint32_t)_mm_movemask_ps(_mm_cmple_ps(a, b));
}

#else

typedef struct dpl_four {
    float v[4];
} dpl_four;

static inline dpl_four dpl_four_all(float v) {
    return (dpl_four){{v, v, v, v}};
}

static inline dpl_four dpl_four_load(const float *from) {
    return (dpl_four){{from[0], from[1], from[2], from[3]}};
}

static inline void dpl_four_store(float *to, dpl_four v) {
    for (int i = 0; i < 4; i++)
        to[i] = v.v[i];
}

static inline dpl_four dpl_four_subtract(dpl_four a, dpl_four b) {
    for (int i = 0; i < 4; i++)
        a.v[i] -= b.v[i];
    return a;
}

static inline dpl_four dpl_four_multiply(dpl_four a, dpl_four b) {
    for (int i = 0; i < 4; i++)
        a.v[i] *= b.v[i];
    return a;
}

static inline dpl_four dpl_four_least(dpl_four a, dpl_four b) {
    for (int i = 0; i < 4; i++)
        a.v[i] = a.v[i] < b.v[i] ? a.v[i] : b.v[i];
    return a;
}

static inline dpl_four dpl_four_most(dpl_four a, dpl_four b) {
    for (int i = 0; i < 4; i++)
        a.v[i] = a.v[i] > b.v[i] ? a.v[i] : b.v[i];
    return a;
}

static inline uint32_t dpl_four_ordered(dpl_four a, dpl_four b) {
    uint32_t bits = 0;
    for (int i = 0; i < 4; i++)
        bits |= (uint32_t)(a.v[i] <= b.v[i]) << i;
    return bits;
}

#endif
#endif
