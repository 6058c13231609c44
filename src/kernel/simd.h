/* Vectors of the native width as GNU vector types, and the few operations that the language lacks. Included
 * by vector.c, which is compiled once per instruction set: the compiler's target decides which of these it
 * gets.
 *
 * Masks are integer vectors of all ones or all zeros per lane. */
#ifndef DPL_KERNEL_SIMD_H
#define DPL_KERNEL_SIMD_H

#include "kernel/half.h"

#if defined(__x86_64__)
#include <immintrin.h>
#endif
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

#if defined(__wasm_simd128__)
#include "kernel/four_lanes_wasm.h"
#elif LANES == 4
#include "kernel/four_lanes_sse2.h"
#endif

static inline vfloat all_float(float v) {
    return v - (vfloat){0}; /* minus zero stays minus zero */
}

static inline vint all_int(int32_t v) {
    return v + (vint){0};
}

static inline vfloat magnitude(vfloat v) {
    return (vfloat)((vint)v & 0x7fffffff);
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
#if LANES == 16
        v = (vfloat)_mm512_maskz_loadu_ps((__mmask16)((1u << count) - 1), from);
#else
        memcpy(&v, from, (size_t)count * sizeof *from);
#endif
    return v;
}

static inline vint load_some_ints(const int32_t *from, int32_t count) {
    return (vint)load_some((const float *)(const void *)from, count);
}

static inline void store_some(float *to, vfloat v, int32_t count) {
    if (count == LANES)
        memcpy(to, &v, sizeof v);
    else
#if LANES == 16
        _mm512_mask_storeu_ps(to, (__mmask16)((1u << count) - 1), (__m512)v);
#else
        memcpy(to, &v, (size_t)count * sizeof *to);
#endif
}

#if defined(__SSE2__)
#define CAN_STREAM true
#else
#define CAN_STREAM false
#endif

/* Can vectors be stored past the caches from here on? */
static inline bool can_stream(const void *to) {
    return CAN_STREAM && (uintptr_t)to % sizeof(vfloat) == 0;
}

/* Stores so; other threads see it after stream_done(). */
static inline void stream(float *to, vfloat v) {
#if LANES == 16
    _mm512_stream_ps(to, (__m512)v);
#elif LANES == 8
    _mm256_stream_ps(to, (__m256)v);
#elif defined(__SSE2__)
    _mm_stream_ps(to, (__m128)v);
#else
    memcpy(to, &v, sizeof v);
#endif
}

/* Vectors of four, whatever the native width. */
static inline void stream_fours(float *to, const void *fours, int32_t count) {
#if defined(__SSE2__)
    for (int32_t i = 0; i < 4 * count; i += 4)
        _mm_stream_ps(to + i, _mm_loadu_ps((const float *)fours + i));
#else
    memcpy(to, fours, (size_t)count * 16);
#endif
}

static inline void stream_done(void) {
#if defined(__SSE2__)
    _mm_sfence();
#endif
}

static inline vint load_ints(const int32_t *from) {
    vint v;
    memcpy(&v, from, sizeof v);
    return v;
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

/* LANES numbers 0 .. 255 to memory. Compilers take vectors apart here, so they are told. */
static inline void store_bytes(uint8_t *to, vint v) {
#if LANES == 16
    _mm_storeu_si128((__m128i *)(void *)to, _mm512_cvtepi32_epi8((__m512i)v));
#elif LANES == 8
    __m128i low = _mm256_castsi256_si128((__m256i)v), high = _mm256_extracti128_si256((__m256i)v, 1);
    __m128i words = _mm_packs_epi32(low, high);
    _mm_storel_epi64((__m128i *)(void *)to, _mm_packus_epi16(words, words));
#else
    four_lanes_store_bytes(to, v);
#endif
}

/* LANES numbers 0 .. 255 from memory. */
static inline vint load_bytes(const uint8_t *from) {
#if LANES == 16
    return (vint)_mm512_cvtepu8_epi32(_mm_loadu_si128((const __m128i *)(const void *)from));
#elif LANES == 8
    return (vint)_mm256_cvtepu8_epi32(_mm_loadl_epi64((const __m128i *)(const void *)from));
#else
    return four_lanes_load_bytes(from);
#endif
}

/* Downwards; anything where the result is no 32-bit number. */
static inline vint floor_to_ints(vfloat v) {
#if LANES == 16
    return (vint)_mm512_cvt_roundps_epi32((__m512)v, _MM_FROUND_TO_NEG_INF | _MM_FROUND_NO_EXC);
#elif LANES == 8
    return (vint)_mm256_cvttps_epi32(_mm256_floor_ps((__m256)v));
#else
    return four_lanes_floor(v);
#endif
}

static inline bool any(vint mask) {
#if LANES == 16
    return _mm512_test_epi32_mask((__m512i)mask, (__m512i)mask) != 0;
#elif LANES == 8
    return _mm256_movemask_ps((__m256)mask) != 0;
#else
    return four_lanes_any(mask);
#endif
}

/* Bit i: lane i of a mask. */
static inline uint32_t lane_bits(vint mask) {
#if LANES == 16
    return _mm512_movepi32_mask((__m512i)mask);
#elif LANES == 8
    return (uint32_t)_mm256_movemask_ps((__m256)mask);
#else
    return four_lanes_bits(mask);
#endif
}

/* a < b ? a : b, and a > b ? a : b, where both are numbers. */
static inline vfloat least(vfloat a, vfloat b) {
#if LANES == 16
    return (vfloat)_mm512_min_ps((__m512)a, (__m512)b);
#elif LANES == 8
    return (vfloat)_mm256_min_ps((__m256)a, (__m256)b);
#else
    return four_lanes_least(a, b);
#endif
}

static inline vfloat greatest(vfloat a, vfloat b) {
#if LANES == 16
    return (vfloat)_mm512_max_ps((__m512)a, (__m512)b);
#elif LANES == 8
    return (vfloat)_mm256_max_ps((__m256)a, (__m256)b);
#else
    return four_lanes_greatest(a, b);
#endif
}

static inline float greatest_lane(vfloat v) {
#if LANES == 16
    v = greatest(v, __builtin_shufflevector(v, v, 8, 9, 10, 11, 12, 13, 14, 15, 0, 1, 2, 3, 4, 5, 6, 7));
    v = greatest(v, __builtin_shufflevector(v, v, 4, 5, 6, 7, 0, 1, 2, 3, 12, 13, 14, 15, 8, 9, 10, 11));
    v = greatest(v, __builtin_shufflevector(v, v, 2, 3, 0, 1, 6, 7, 4, 5, 10, 11, 8, 9, 14, 15, 12, 13));
    v = greatest(v, __builtin_shufflevector(v, v, 1, 0, 3, 2, 5, 4, 7, 6, 9, 8, 11, 10, 13, 12, 15, 14));
#elif LANES == 8
    v = greatest(v, __builtin_shufflevector(v, v, 4, 5, 6, 7, 0, 1, 2, 3));
    v = greatest(v, __builtin_shufflevector(v, v, 2, 3, 0, 1, 6, 7, 4, 5));
    v = greatest(v, __builtin_shufflevector(v, v, 1, 0, 3, 2, 5, 4, 7, 6));
#else
    v = greatest(v, __builtin_shufflevector(v, v, 2, 3, 0, 1));
    v = greatest(v, __builtin_shufflevector(v, v, 1, 0, 3, 2));
#endif
    return v[0];
}

static inline vfloat square_root(vfloat v) {
#if LANES == 16
    return (vfloat)_mm512_sqrt_ps((__m512)v);
#elif LANES == 8
    return (vfloat)_mm256_sqrt_ps((__m256)v);
#else
    return four_lanes_square_root(v);
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

/* table[index] in every lane. */
static inline vint gather_ints(const int32_t *table, vint index) {
#if LANES == 16
    return (vint)_mm512_i32gather_epi32((__m512i)index, table, 4);
#elif LANES == 8
    return (vint)_mm256_i32gather_epi32(table, (__m256i)index, 4);
#else
    vint values;
    for (int i = 0; i < LANES; i++)
        values[i] = table[index[i]];
    return values;
#endif
}

/* ---- half precision: equal to half.h bit for bit, for whatever bits ---------------------------------- */

/* LANES halves from memory, exact. */
static inline vfloat load_half(const uint16_t *from) {
#if LANES == 16
    return (vfloat)_mm512_cvtph_ps(_mm256_loadu_si256((const __m256i *)(const void *)from));
#elif LANES == 8
    return (vfloat)_mm256_cvtph_ps(_mm_loadu_si128((const __m128i *)(const void *)from));
#else
    vint half = four_lanes_load_u16(from);
    vint magnitude = half & 0x7fff;
    vfloat subnormal = to_float(magnitude) * 0x1p-24f;
    vint above = magnitude >= 0x7c00; /* infinity and not-a-number */
    vint bits = (magnitude << 13) + HALF_BIAS_BITS + (above & HALF_BIAS_BITS);
    bits |= (magnitude > 0x7c00) & 0x400000;
    return (vfloat)(select_int(magnitude < 0x400, (vint)subnormal, bits) | (half << 16 & INT32_MIN));
#endif
}

/* The same for light, which is never negative and never not-a-number: a third of the work. */
static inline void store_half_light(uint16_t *to, vfloat v) {
#if LANES == 16
    v = (vfloat)_mm512_min_ps((__m512)v, _mm512_set1_ps(HALF_MAX));
    _mm256_storeu_si256((__m256i *)(void *)to, _mm512_cvtps_ph((__m512)v, _MM_FROUND_TO_NEAREST_INT));
#elif LANES == 8
    v = (vfloat)_mm256_min_ps((__m256)v, _mm256_set1_ps(HALF_MAX));
    _mm_storeu_si128((__m128i *)(void *)to, _mm256_cvtps_ph((__m256)v, _MM_FROUND_TO_NEAREST_INT));
#else
    v = four_lanes_least(v, all_float(HALF_MAX));
    vint magnitude = (vint)v;
    vint normal = (magnitude + 0xfff + (magnitude >> 13 & 1) - HALF_BIAS_BITS) >> 13;
    vint subnormal = (vint)((vfloat)magnitude + 0.5f) - 0x3f000000;
    vint half = select_int(magnitude < HALF_NORMAL_BITS, subnormal, normal);
    four_lanes_store_i16(to, half);
#endif
}

/* LANES halves to memory: nearest, ties to even, at most HALF_MAX either side, not-a-number as 0. */
static inline void store_half(uint16_t *to, vfloat v) {
    v = (vfloat)((vint)v & (v == v));
    v = select_float(v > HALF_MAX, all_float(HALF_MAX), v);
    v = select_float(v < -HALF_MAX, all_float(-HALF_MAX), v);
#if LANES == 16
    _mm256_storeu_si256((__m256i *)(void *)to, _mm512_cvtps_ph((__m512)v, _MM_FROUND_TO_NEAREST_INT));
#elif LANES == 8
    _mm_storeu_si128((__m128i *)(void *)to, _mm256_cvtps_ph((__m256)v, _MM_FROUND_TO_NEAREST_INT));
#else
    vint magnitude = (vint)v & 0x7fffffff;
    vint normal = (magnitude + 0xfff + (magnitude >> 13 & 1) - HALF_BIAS_BITS) >> 13;
    vint subnormal = (vint)((vfloat)magnitude + 0.5f) - 0x3f000000; /* a float's step at 1/2 is 2^-24 */
    vint half = select_int(magnitude < HALF_NORMAL_BITS, subnormal, normal) | ((vint)v >> 16 & 0x8000);
    half = half << 16 >> 16; /* signed 16-bit numbers pack without saturating */
    four_lanes_store_i16(to, half);
#endif
}

#endif
