/* The scalar reference of the kernels `aim` and `list_hits`, see ray_words.h. */
#include "kernel/ray_words_ref.h"

#include "kernel/bits.h"

static float position(int32_t number, float spacing) {
    return ((float)number + 0.5f) * spacing;
}

static int32_t target_of(const dpl_ray_axis *axis, const dpl_ray_word *word, int32_t probe) {
    int32_t target = (probe + word->step) >> word->shift;
    return target < 0 ? 0 : target < axis->targets ? target : axis->targets - 1;
}

int32_t dpl_aim_ref(const dpl_ray_axis *axis, int32_t count, const dpl_ray_word *words,
                    float *const ends[4]) {
    int32_t i = 0;
    for (const dpl_ray_word *word = words; word < words + count; word++)
        for (uint64_t rays = word->rays; rays; rays &= rays - 1, i++) {
            int32_t probe = word->first + dpl_bit_lowest(rays);
            ends[0][i] = position(probe, axis->spacing) + word->start_x;
            ends[1][i] = word->y0;
            ends[2][i] = position(target_of(axis, word, probe), axis->target_spacing) + word->end_x;
            ends[3][i] = word->y1;
        }
    return i;
}

int32_t dpl_list_hits_ref(int32_t count, dpl_ray_word *words, const int32_t *cell, int32_t *list) {
    int32_t listed = 0;
    for (dpl_ray_word *word = words; word < words + count; word++) {
        uint64_t hits = 0;
        word->at = listed;
        for (uint64_t rays = word->rays | word->known; rays; rays &= rays - 1) {
            uint64_t bit = rays & (0 - rays), is_known = (bit & word->known) != 0;
            int32_t end = *(is_known ? &word->ends[dpl_bit_lowest(rays)] : cell), hit = end >= 0;
            cell += !is_known;
            hits |= bit & (0 - (uint64_t)hit);
            list[listed] = end;
            listed += hit;
        }
        *word->hits = hits;
    }
    return listed;
}
