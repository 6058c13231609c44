/* Rays of 64 neighbouring probes at a time, in vectors: a vector of neighbours, of which those that are
 * wanted are packed. Operation for operation what ray_words_ref.c does. Included by vector.c alone. */
#ifndef DPL_KERNEL_VECTOR_RAY_WORDS_H
#define DPL_KERNEL_VECTOR_RAY_WORDS_H

#include "kernel/lanes.h"
#include "kernel/ray_words_ref.h"

#if LANES == 4

static int32_t aim(const dpl_ray_axis *axis, int32_t count, const dpl_ray_word *words, float *const ends[4]) {
    return dpl_aim_ref(axis, count, words, ends); /* a third quicker than vectors of four */
}

#else

static int32_t aim(const dpl_ray_axis *axis, int32_t count, const dpl_ray_word *words, float *const ends[4]) {
    float *x0 = ends[0], *y0 = ends[1], *x1 = ends[2], *y1 = ends[3];
    int32_t n = 0;
    for (const dpl_ray_word *word = words; word < words + count; word++) {
        vint probe = word->first + lane_numbers();
        for (uint64_t left = word->rays; left; left >>= LANES, probe += LANES) {
            packing p = packing_of(lanes_of_bits((uint32_t)left));
            if (p.count == 0)
                continue;
            vint target = (probe + word->step) >> word->shift;
            target = clamp_ints(target, axis->targets - 1);
            pack_floats(&p, x0 + n, (to_float(probe) + 0.5f) * axis->spacing + word->start_x);
            pack_floats(&p, x1 + n, (to_float(target) + 0.5f) * axis->target_spacing + word->end_x);
            store_some(y0 + n, all_float(word->y0), LANES);
            store_some(y1 + n, all_float(word->y1), LANES);
            n += p.count;
        }
    }
    return n;
}

#endif

#if LANES == 16

static int32_t list_hits(int32_t count, dpl_ray_word *words, const int32_t *cell, int32_t *list) {
    int32_t listed = 0;
    for (dpl_ray_word *word = words; word < words + count; word++) {
        uint64_t hits = 0;
        word->at = listed;
        for (int32_t k = 0; k < 64; k += LANES) {
            uint32_t marched = (uint32_t)(word->rays >> k) & 0xffff,
                     known = (uint32_t)(word->known >> k) & 0xffff;
            if (!(marched | known))
                continue;
            __m512i end =
                _mm512_mask_expand_epi32(_mm512_set1_epi32(-1), (__mmask16)marched, _mm512_loadu_si512(cell));
            if (known)
                end = _mm512_mask_loadu_epi32(end, (__mmask16)known, word->ends + k);
            vlanes hit = _mm512_cmpge_epi32_mask(end, _mm512_setzero_si512());
            packing p = packing_of(hit);
            pack_ints(&p, list + listed, (vint)end);
            listed += p.count;
            cell += __builtin_popcount(marched);
            hits |= (uint64_t)bits_of_lanes(hit) << k;
        }
        *word->hits = hits;
    }
    return listed;
}

#else /* no instruction that packs: the loop is as quick */

static int32_t list_hits(int32_t count, dpl_ray_word *words, const int32_t *cell, int32_t *list) {
    return dpl_list_hits_ref(count, words, cell, list);
}

#endif

#endif
