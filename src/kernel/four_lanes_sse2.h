/* What vectors of four lanes need of SSE2. Included by simd.h alone, behind its types; four_lanes_wasm.h is
 * the same for WebAssembly. */
#ifndef DPL_KERNEL_FOUR_LANES_SSE2_H
#define DPL_KERNEL_FOUR_LANES_SSE2_H

/* Is any lane of a mask set? */
static inline bool four_lanes_any(vint mask) {
    return _mm_movemask_ps((__m128)mask) != 0;
}

/* Bit i: lane i of a mask. */
static inline uint32_t four_lanes_bits(vint mask) {
    return (uint32_t)_mm_movemask_ps((__m128)mask);
}

static inline vfloat four_lanes_square_root(vfloat v) {
    return (vfloat)_mm_sqrt_ps((__m128)v);
}

/* Downwards; anything where the result is no 32-bit number. */
static inline vint four_lanes_floor(vfloat v) {
    __m128i i = _mm_cvttps_epi32((__m128)v);
    __m128i above = _mm_castps_si128(_mm_cmpgt_ps(_mm_cvtepi32_ps(i), (__m128)v));
    return (vint)_mm_add_epi32(i, above); /* a mask is -1 where it holds */
}

/* a < b ? a : b, so b where one is not a number. */
static inline vfloat four_lanes_least(vfloat a, vfloat b) {
    return (vfloat)_mm_min_ps((__m128)a, (__m128)b);
}

/* a > b ? a : b, so b where one is not a number. */
static inline vfloat four_lanes_greatest(vfloat a, vfloat b) {
    return (vfloat)_mm_max_ps((__m128)a, (__m128)b);
}

/* Four bytes from memory. */
static inline vint four_lanes_load_bytes(const uint8_t *from) {
    int32_t bytes;
    memcpy(&bytes, from, sizeof bytes);
    __m128i zero = _mm_setzero_si128(), words = _mm_unpacklo_epi8(_mm_cvtsi32_si128(bytes), zero);
    return (vint)_mm_unpacklo_epi16(words, zero);
}

/* Four 16-bit numbers from memory, never negative. */
static inline vint four_lanes_load_u16(const uint16_t *from) {
    __m128i packed = _mm_loadl_epi64((const __m128i *)(const void *)from);
    return (vint)_mm_unpacklo_epi16(packed, _mm_setzero_si128());
}

/* Lanes within -32768 .. 32767 to memory. */
static inline void four_lanes_store_i16(uint16_t *to, vint v) {
    _mm_storel_epi64((__m128i *)(void *)to, _mm_packs_epi32((__m128i)v, (__m128i)v));
}

static inline void four_lanes_store_bytes(uint8_t *to, vint v) {
    __m128i words = _mm_packs_epi32((__m128i)v, (__m128i)v);
    int32_t bytes = _mm_cvtsi128_si32(_mm_packus_epi16(words, words));
    memcpy(to, &bytes, sizeof bytes);
}

#endif
