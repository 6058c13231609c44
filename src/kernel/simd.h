/* Vectors of the native width as GNU vector types, and the few operations that the language lacks. Included
 * by vector.c, which is compiled once per instruction set: the compiler's target decides which of these it
 * gets.
 *
 * Masks are integer vectors of all ones or all zeros per lane. */
#ifndef DPL_KERNEL_SIMD_H
#define DPL_KERNEL_SIMD_H

#include <immintrin.h>
#include <stdbool.h>
#include <stdint.h>
#include <string.h>

#if defined(__AVX512F__)
#define LANES 16
#elif defined(__AVX2__)
#define LANES 8
#else
#define LANES 4
#endif

typedef float vfloat __attribute__((vector_size(4 * LANES)));
typedef int32_t vint __attribute__((vector_size(4 * LANES)));

static inline vfloat all_float(float v) {
    return v - (vfloat){0}; /* minus zero stays minus zero */
}

static inline vint all_int(int32_t v) {
    return v + (vint){0};
}

static inline vint lane_numbers(void) {
#if LANES == 16
    return (vint){0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15};
#elif LANES == 8
    return (vint){0, 1, 2, 3, 4, 5, 6, 7};
#else
    return (vint){0, 1, 2, 3};
#endif
}

/* The first `count` lanes from memory, zero in the rest; and back. */
static inline vfloat load_some(const float *from, int32_t count) {
    vfloat v = {0};
    if (count == LANES)
        memcpy(&v, from, sizeof v);
    else
        memcpy(&v, from, (size_t)count * sizeof *from);
    return v;
}

static inline void store_some(float *to, vfloat v, int32_t count) {
    if (count == LANES)
        memcpy(to, &v, sizeof v);
    else
        memcpy(to, &v, (size_t)count * sizeof *to);
}

static inline void store_some_ints(int32_t *to, vint v, int32_t count) {
    if (count == LANES)
        memcpy(to, &v, sizeof v);
    else
        memcpy(to, &v, (size_t)count * sizeof *to);
}

static inline vfloat select_float(vint mask, vfloat yes, vfloat no) {
    return (vfloat)((mask & (vint)yes) | (~mask & (vint)no));
}

static inline vint select_int(vint mask, vint yes, vint no) {
    return (mask & yes) | (~mask & no);
}

static inline vfloat to_float(vint v) {
    return __builtin_convertvector(v, vfloat);
}

/* Towards zero. */
static inline vint to_int(vfloat v) {
    return __builtin_convertvector(v, vint);
}

static inline vint floor_to_ints(vfloat v) {
    vint i = to_int(v);
    return i + (to_float(i) > v); /* a mask is -1 where it holds */
}

static inline bool any(vint mask) {
#if LANES == 16
    return _mm512_test_epi32_mask((__m512i)mask, (__m512i)mask) != 0;
#elif LANES == 8
    return _mm256_movemask_ps((__m256)mask) != 0;
#else
    return _mm_movemask_ps((__m128)mask) != 0;
#endif
}

static inline vfloat square_root(vfloat v) {
#if LANES == 16
    return (vfloat)_mm512_sqrt_ps((__m512)v);
#elif LANES == 8
    return (vfloat)_mm256_sqrt_ps((__m256)v);
#else
    return (vfloat)_mm_sqrt_ps((__m128)v);
#endif
}

/* table[index] in lanes of the mask; `otherwise` elsewhere, where the index may be anything. */
static inline vfloat gather(vint mask, const float *table, vint index, vfloat otherwise) {
#if LANES == 16
    __mmask16 lanes = _mm512_test_epi32_mask((__m512i)mask, (__m512i)mask);
    return (vfloat)_mm512_mask_i32gather_ps((__m512)otherwise, lanes, (__m512i)index, table, 4);
#elif LANES == 8
    return (vfloat)_mm256_mask_i32gather_ps((__m256)otherwise, table, (__m256i)index, (__m256)mask, 4);
#else
    for (int i = 0; i < LANES; i++)
        if (mask[i])
            otherwise[i] = table[index[i]];
    return otherwise;
#endif
}

#endif
