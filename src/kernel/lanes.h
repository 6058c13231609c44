/* Which lanes of a vector: a register of bits on AVX-512, elsewhere a vector of masks. With them an
 * instruction set's own way of choosing between lanes is used, which compilers do not find in masks of
 * integers: a march does little else. Included by vector_march.h. */
#ifndef DPL_KERNEL_LANES_H
#define DPL_KERNEL_LANES_H

#include "kernel/simd.h"

#if LANES == 16
typedef __mmask16 vlanes;
#else
typedef vint vlanes;
#endif

/* & and | work on lanes as they are; this is a & ~b. */
static inline vlanes lanes_but(vlanes a, vlanes b) {
    return (vlanes)(a & ~b);
}

/* a < b; false where one is not a number. */
static inline vlanes lanes_below(vfloat a, vfloat b) {
#if LANES == 16
    return _mm512_cmp_ps_mask((__m512)a, (__m512)b, _CMP_LT_OQ);
#else
    return a < b;
#endif
}

static inline vlanes lanes_at_most(vfloat a, vfloat b) {
#if LANES == 16
    return _mm512_cmp_ps_mask((__m512)a, (__m512)b, _CMP_LE_OQ);
#else
    return a <= b;
#endif
}

static inline vlanes lanes_equal(vfloat a, vfloat b) {
#if LANES == 16
    return _mm512_cmp_ps_mask((__m512)a, (__m512)b, _CMP_EQ_OQ);
#else
    return a == b;
#endif
}

/* 0 <= v < count. */
static inline vlanes lanes_within(vint v, int32_t count) {
#if LANES == 16
    return _mm512_cmplt_epu32_mask((__m512i)v, (__m512i)all_int(count));
#else
    return (v >= 0) & (v < count);
#endif
}

static inline vlanes first_lanes(int32_t count) {
#if LANES == 16
    return (vlanes)(count < LANES ? (1 << count) - 1 : 0xffff);
#else
    return lane_numbers() < count;
#endif
}

/* Bit i: lane i. Not by a plain conversion: of a mask of two bytes that gcc 12 keeps in memory it may count
 * the bits of four. */
static inline uint32_t bits_of_lanes(vlanes l) {
#if LANES == 16
    return _cvtmask16_u32(l);
#else
    return lane_bits(l);
#endif
}

#if LANES > 4
/* Lane i: bit i. */
static inline vlanes lanes_of_bits(uint32_t bits) {
#if LANES == 16
    return (vlanes)bits;
#else
    return (all_int((int32_t)bits) & (vint){1, 2, 4, 8, 16, 32, 64, 128}) != 0;
#endif
}
#endif

static inline bool any_lane(vlanes l) {
#if LANES == 16
    return l != 0;
#else
    return any(l);
#endif
}

static inline int32_t count_lanes(vlanes l) {
    return __builtin_popcount(bits_of_lanes(l));
}

static inline vfloat choose(vlanes l, vfloat yes, vfloat no) {
#if LANES == 16
    return (vfloat)_mm512_mask_blend_ps(l, (__m512)no, (__m512)yes);
#else
    return select_float(l, yes, no);
#endif
}

static inline vint choose_ints(vlanes l, vint yes, vint no) {
#if LANES == 16
    return (vint)_mm512_mask_blend_epi32(l, (__m512i)no, (__m512i)yes);
#else
    return select_int(l, yes, no);
#endif
}

/* table[index] in those lanes; `otherwise` elsewhere, where the index may be anything. */
static inline vfloat gather_lanes(vlanes l, const float *table, vint index, vfloat otherwise) {
#if LANES == 16
    return (vfloat)_mm512_mask_i32gather_ps((__m512)otherwise, l, (__m512i)index, table, 4);
#else
    return gather(l, table, index, otherwise);
#endif
}

/* How to put some lanes side by side. Except on AVX-512 each half by itself, and then one half behind the
 * other. */
typedef struct packing {
    int32_t count;
#if LANES == 16
    vlanes from;
#elif LANES == 8
    __m256i from;  /* in each half: which lane */
    int32_t lower; /* how many in the lower half */
#else
    vlanes stays;  /* a half of two: its first lane, unless only the second is wanted */
    int32_t lower; /* how many in the lower half */
#endif
} packing;

static inline packing packing_of(vlanes l) {
    uint32_t bits = bits_of_lanes(l);
    packing p = {.count = __builtin_popcount(bits)};
#if LANES == 16
    p.from = l;
#elif LANES == 8
    static const int32_t from[16][4] = {{0},    {0},       {1},       {0, 1},      {2},    {0, 2},
                                        {1, 2}, {0, 1, 2}, {3},       {0, 3},      {1, 3}, {0, 1, 3},
                                        {2, 3}, {0, 2, 3}, {1, 2, 3}, {0, 1, 2, 3}};
    p.from = _mm256_loadu2_m128i((const __m128i *)(const void *)from[bits >> 4],
                                 (const __m128i *)(const void *)from[bits & 15]);
    p.lower = __builtin_popcount(bits & 15);
#else
    p.stays = l | (vint){0, -1, 0, -1};
    p.lower = (int32_t)((bits & 1) + (bits >> 1 & 1));
#endif
    return p;
}

/* Writes those lanes, and whatever behind them: there must be room for a whole vector. */
static inline void pack_ints(const packing *p, int32_t *to, vint v) {
#if LANES == 16
    _mm512_storeu_si512(to, _mm512_maskz_compress_epi32(p->from, (__m512i)v));
#elif LANES == 8
    __m256 packed = _mm256_permutevar_ps((__m256)v, p->from);
    _mm_storeu_ps((float *)(void *)to, _mm256_castps256_ps128(packed));
    _mm_storeu_ps((float *)(void *)(to + p->lower), _mm256_extractf128_ps(packed, 1));
#else
    vint packed = select_int(p->stays, v, __builtin_shufflevector(v, v, 1, 1, 3, 3));
    memcpy(to, &packed, 2 * sizeof *to);
    memcpy(to + p->lower, (const int32_t *)&packed + 2, 2 * sizeof *to);
#endif
}

static inline void pack_floats(const packing *p, float *to, vfloat v) {
    pack_ints(p, (int32_t *)(void *)to, (vint)v);
}

/* table[index] in every lane, by channel. Whole pixels are loaded and then turned: a third of the loads of
 * three gathers. */
static inline void gather_rgb(const float (*table)[4], vint index, vfloat rgb[3]) {
    int32_t at[LANES];
    store_some_ints(at, index, LANES);
#if LANES == 16
    __m512 row[4];
    for (int i = 0; i < 4; i++) {
        row[i] = _mm512_castps128_ps512(_mm_loadu_ps(table[at[i]]));
        row[i] = _mm512_insertf32x4(row[i], _mm_loadu_ps(table[at[4 + i]]), 1);
        row[i] = _mm512_insertf32x4(row[i], _mm_loadu_ps(table[at[8 + i]]), 2);
        row[i] = _mm512_insertf32x4(row[i], _mm_loadu_ps(table[at[12 + i]]), 3);
    }
    __m512 low = _mm512_unpacklo_ps(row[0], row[1]), high = _mm512_unpacklo_ps(row[2], row[3]);
    rgb[0] = (vfloat)_mm512_shuffle_ps(low, high, 0x44);
    rgb[1] = (vfloat)_mm512_shuffle_ps(low, high, 0xee);
    low = _mm512_unpackhi_ps(row[0], row[1]);
    high = _mm512_unpackhi_ps(row[2], row[3]);
    rgb[2] = (vfloat)_mm512_shuffle_ps(low, high, 0x44);
#elif LANES == 8
    __m256 row[4];
    for (int i = 0; i < 4; i++) {
        row[i] = _mm256_castps128_ps256(_mm_loadu_ps(table[at[i]]));
        row[i] = _mm256_insertf128_ps(row[i], _mm_loadu_ps(table[at[4 + i]]), 1);
    }
    __m256 low = _mm256_unpacklo_ps(row[0], row[1]), high = _mm256_unpacklo_ps(row[2], row[3]);
    rgb[0] = (vfloat)_mm256_shuffle_ps(low, high, 0x44);
    rgb[1] = (vfloat)_mm256_shuffle_ps(low, high, 0xee);
    low = _mm256_unpackhi_ps(row[0], row[1]);
    high = _mm256_unpackhi_ps(row[2], row[3]);
    rgb[2] = (vfloat)_mm256_shuffle_ps(low, high, 0x44);
#else
    vfloat row[4];
    for (int i = 0; i < 4; i++)
        memcpy(&row[i], table[at[i]], sizeof row[i]);
    vfloat low = __builtin_shufflevector(row[0], row[1], 0, 4, 1, 5),
           high = __builtin_shufflevector(row[2], row[3], 0, 4, 1, 5);
    rgb[0] = __builtin_shufflevector(low, high, 0, 1, 4, 5);
    rgb[1] = __builtin_shufflevector(low, high, 2, 3, 6, 7);
    low = __builtin_shufflevector(row[0], row[1], 2, 6, 3, 7);
    high = __builtin_shufflevector(row[2], row[3], 2, 6, 3, 7);
    rgb[2] = __builtin_shufflevector(low, high, 0, 1, 4, 5);
#endif
}

#endif
