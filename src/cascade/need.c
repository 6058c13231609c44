/* Which slots of a level are needed: a probe's slot is, when a probe of the level below that interpolates it
 * has a ray towards it that lets light through. Part of the survey, see survey.h.
 *
 * Lossless: where a ray below ends at an opaque pixel, its transmittance is 0 and what is behind it is
 * multiplied away. */
#include "cascade/aim.h"
#include "cascade/survey.h"

/* Bits 0, 2, 4 … moved together into the lower half. */
static uint64_t gather_even_bits(uint64_t v) {
    v &= 0x5555555555555555u;
    v = (v | v >> 1) & 0x3333333333333333u;
    v = (v | v >> 2) & 0x0f0f0f0f0f0f0f0fu;
    v = (v | v >> 4) & 0x00ff00ff00ff00ffu;
    v = (v | v >> 8) & 0x0000ffff0000ffffu;
    return (v | v >> 16) & 0x00000000ffffffffu;
}

/* Bit i of the result: bit 2i or 2i + 1. */
static uint64_t join_pairs(uint64_t v) {
    return gather_even_bits(v | v >> 1);
}

/* A row of probes whose ray is open: needed and without a hit. */
static uint64_t open_word(const dpl_survey_level *level, int32_t ray, int32_t aim, int32_t row,
                          int32_t word) {
    if (word < 0 || word >= level->needed.words)
        return 0;
    uint64_t needed = dpl_mask_row(&level->needed, ray / DPL_BRANCHING, row)[word];
    return level->traced ? needed & ~dpl_mask_row(&level->hits, ray * level->aims + aim, row)[word] : needed;
}

/* Probes of a row, moved by `shift` (-1, 0, 1) places to the right, as pairs that share a parent: 64 parents'
 * worth. */
static uint64_t parents_of_pairs(const dpl_survey_level *level, int32_t ray, int32_t aim, int32_t row,
                                 int32_t word, int32_t shift) {
    uint64_t before = open_word(level, ray, aim, row, 2 * word - 1),
             low = open_word(level, ray, aim, row, 2 * word),
             high = open_word(level, ray, aim, row, 2 * word + 1),
             after = open_word(level, ray, aim, row, 2 * word + 2);
    if (shift > 0) {
        high = high << 1 | low >> (DPL_MASK_BITS - 1);
        low = low << 1 | before >> (DPL_MASK_BITS - 1);
    } else if (shift < 0) {
        low = low >> 1 | high << (DPL_MASK_BITS - 1);
        high = high >> 1 | after << (DPL_MASK_BITS - 1);
    }
    return join_pairs(low) | join_pairs(high) << (DPL_MASK_BITS / 2);
}

/* Child x lies between parents (x-1)/2 and that plus one: seen from its pair, the lower parent takes the pair
 * that begins one further, the upper one the pair that begins one earlier. At the border the nearest stands
 * in for one that is missing. */
static uint64_t open_towards(const dpl_survey_task *t, int32_t ray, int32_t aim, int32_t row, int32_t word,
                             int32_t shift) {
    const dpl_survey_level *below = t->below;
    int32_t last = t->level->plan->probes_x - 1, last_child = 2 * last + 1;
    uint64_t found = parents_of_pairs(below, ray, aim, row, word, shift);
    if (shift < 0 && word == 0)
        found |= open_word(below, ray, aim, row, 0) & 1;
    if (shift > 0 && word == last / DPL_MASK_BITS && last_child < below->plan->probes_x &&
        open_word(below, ray, aim, row, last_child / DPL_MASK_BITS) >> last_child % DPL_MASK_BITS & 1)
        found |= (uint64_t)1 << last % DPL_MASK_BITS;
    return found & dpl_mask_all(&t->level->needed, word);
}

/* One word of a row of parents from one row of children. */
static uint64_t needed_by_row(const dpl_survey_task *t, int32_t ray, int32_t row, int32_t child_row,
                              int32_t word) {
    const dpl_survey_level *below = t->below;
    int32_t lower = dpl_lower_parent(child_row), rows = t->level->plan->probes_y;
    if (below->merge == DPL_MERGE_NEAREST_FIX)
        return child_row / 2 == row ? open_towards(t, ray, 0, child_row, word, 0) : 0;
    uint64_t found = 0;
    for (int upper = 0; upper < 2; upper++)
        for (int right = 0; right < 2 && dpl_clamp_index(lower + upper, rows) == row; right++)
            found |= open_towards(t, ray, below->aims == 4 ? 2 * upper + right : 0, child_row, word,
                                  right ? 1 : -1);
    return found;
}

/* Level 0 is read by the pixels: all of it, but for walls that show their own colour. */
static void need_of_pixels(const dpl_survey_task *t, int32_t row, uint64_t *needed) {
    const dpl_survey_level *level = t->level;
    for (int32_t w = 0; w < level->needed.words; w++)
        needed[w] = dpl_mask_all(&level->needed, w);
    if (!t->walls_unseen || level->plan->spacing != 1.0)
        return; /* with fewer probes than pixels, a probe in a wall may stand in for one that is missing */
    for (int32_t x = 0; x < level->plan->probes_x; x++)
        if (dpl_field_is_opaque(t->field, x, row))
            needed[x / DPL_MASK_BITS] &= ~((uint64_t)1 << x % DPL_MASK_BITS);
}

void dpl_survey_need(int32_t begin, int32_t end, int32_t worker, void *task) {
    (void)worker;
    const dpl_survey_task *t = task;
    const dpl_survey_level *level = t->level;
    int32_t rows = level->plan->probes_y;
    for (int32_t item = begin; item < end; item++) {
        int32_t slot = item / rows, row = item % rows;
        uint64_t *needed = dpl_mask_row(&level->needed, slot, row);
        if (!t->below) {
            need_of_pixels(t, row, needed);
            continue;
        }
        int32_t first = 2 * row - 1, last = 2 * row + 2, child_rows = t->below->plan->probes_y;
        for (int32_t w = 0; w < level->needed.words; w++) {
            needed[w] = 0;
            for (int32_t y = first < 0 ? 0 : first; y <= last && y < child_rows; y++)
                needed[w] |= needed_by_row(t, slot, row, y, w);
        }
    }
}
