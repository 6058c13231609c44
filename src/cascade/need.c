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

/* Words of the longest row of probes, and a few around. */
#define MOST_WORDS (DPL_MAX_SIZE / DPL_MASK_BITS + 8)

/* Rays of the level below that are looked at together: one direction, one aim, up to four rows of probes. */
typedef struct row_set {
    int32_t rows[4];
    int32_t count;
    bool lower, upper;         /* which of the parents around them they see; neither: the nearest */
    uint64_t open[MOST_WORDS]; /* word w + 1: probes that have an open ray, one needed and without a hit */
} row_set;

/* Fills in `open`, as far as so many words of parents read it. False when nothing is. */
static bool find_open(const dpl_survey_level *below, int32_t ray, int32_t aim, int32_t parent_words,
                      row_set *set) {
    int32_t size = 2 * parent_words + 2;
    int32_t words = below->needed.words < size - 1 ? below->needed.words : size - 1;
    uint64_t any = 0;
    for (int32_t w = 0; w < size; w++)
        set->open[w] = 0;
    for (int32_t i = 0; i < set->count; i++) {
        const uint64_t *needed = dpl_mask_row(&below->needed, ray / DPL_BRANCHING, set->rows[i]);
        const uint64_t *hits = dpl_mask_row(&below->hits, ray * below->aims + aim, set->rows[i]);
        for (int32_t w = 0; w < words; w++)
            any |= set->open[w + 1] |= needed[w] & ~(below->traced ? hits[w] : 0);
    }
    return any != 0;
}

/* At the border of the picture the nearest parent stands in for one that is missing. */
static uint64_t at_borders(const row_set *set, int32_t word, int32_t parents, int32_t probes) {
    int32_t last_child = 2 * parents - 1;
    uint64_t found = set->lower && word == 0 ? set->open[1] & 1 : 0;
    if (set->upper && word == (parents - 1) / DPL_MASK_BITS && last_child < probes &&
        (set->open[last_child / DPL_MASK_BITS + 1] >> last_child % DPL_MASK_BITS & 1))
        found |= (uint64_t)1 << (parents - 1) % DPL_MASK_BITS;
    return found;
}

/* Parent i as the lower of two is seen by probes 2i+1 and 2i+2, as the upper of two by 2i-1 and 2i; as the
 * nearest, standing between them, by 2i and 2i+1. */
static uint64_t parents_of(const row_set *set, int32_t word) {
    const int top = DPL_MASK_BITS - 1;
    const uint64_t *p = &set->open[2 * word]; /* 128 probes from p[1] on, and those to either side */
    uint64_t low = 0, high = 0;
    if (!set->lower && !set->upper) {
        low = p[1];
        high = p[2];
    }
    if (set->lower) {
        low = p[1] >> 1 | p[2] << top;
        high = p[2] >> 1 | p[3] << top;
    }
    if (set->upper) {
        low |= p[1] << 1 | p[0] >> top;
        high |= p[2] << 1 | p[1] >> top;
    }
    return join_pairs(low) | join_pairs(high) << (DPL_MASK_BITS / 2);
}

/* Adds those of a row of parents that the rays of the set see. */
static void add_needed(const dpl_survey_task *t, int32_t slot, int32_t aim, row_set *set, uint64_t *needed) {
    const dpl_mask *mask = &t->level->needed;
    if (!find_open(t->below, slot, aim, mask->words, set))
        return;
    for (int32_t w = 0; w < mask->words; w++)
        needed[w] |= (parents_of(set, w) | at_borders(set, w, mask->probes, t->below->plan->probes_x)) &
                     dpl_mask_all(mask, w);
}

/* Adds the rows whose parent, `upper` of the two around them, is `row`. */
static void add_rows(row_set *set, int32_t row, int32_t children, int32_t rows, int32_t upper) {
    int32_t last = 2 * row + 2 < children ? 2 * row + 2 : children - 1;
    for (int32_t y = row > 0 ? 2 * row - 1 : 0; y <= last; y++)
        if (dpl_clamp_index(dpl_lower_parent(y) + upper, rows) == row &&
            (set->count == 0 || set->rows[set->count - 1] < y))
            set->rows[set->count++] = y;
}

/* A row of parents in one slot. */
static void need_of_rays(const dpl_survey_task *t, int32_t slot, int32_t row, uint64_t *needed) {
    const dpl_survey_level *below = t->below;
    row_set set; /* most of it is never used */
    set.count = 0;
    for (int32_t w = 0; w < t->level->needed.words; w++)
        needed[w] = 0;
    if (below->merge == DPL_MERGE_BILINEAR_FIX) {
        for (int32_t aim = 0; aim < 4; aim++) {
            set.count = 0;
            set.upper = aim & 1;
            set.lower = !set.upper;
            add_rows(&set, row, below->plan->probes_y, t->level->plan->probes_y, aim >> 1);
            add_needed(t, slot, aim, &set, needed);
        }
        return;
    }
    bool nearest = below->merge == DPL_MERGE_NEAREST_FIX;
    set.lower = set.upper = !nearest;
    for (int32_t y = nearest || row == 0 ? 2 * row : 2 * row - 1; y <= 2 * row + (nearest ? 1 : 2); y++)
        if (y < below->plan->probes_y)
            set.rows[set.count++] = y;
    add_needed(t, slot, 0, &set, needed);
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
        if (t->below)
            need_of_rays(t, slot, row, needed);
        else
            need_of_pixels(t, row, needed);
    }
}
