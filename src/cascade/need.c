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

/* Rays of the level below that are looked at together: one direction, one aim, up to four rows of probes. */
typedef struct row_set {
    const dpl_survey_level *level;
    int32_t ray, aim;
    int32_t rows[4];
    int32_t count;
} row_set;

/* Probes that have an open ray in any of the rows: needed, and without a hit. */
static uint64_t open_word(const row_set *set, int32_t word) {
    const dpl_survey_level *level = set->level;
    uint64_t open = 0;
    if (word < 0 || word >= level->needed.words)
        return 0;
    for (int32_t i = 0; i < set->count; i++) {
        uint64_t needed = dpl_mask_row(&level->needed, set->ray / DPL_BRANCHING, set->rows[i])[word];
        uint64_t hits =
            level->traced ? dpl_mask_row(&level->hits, set->ray * level->aims + set->aim, set->rows[i])[word]
                          : 0;
        open |= needed & ~hits;
    }
    return open;
}

/* 192 probes: two words that 64 parents lie between, and one bit to either side. */
typedef struct open_probes {
    uint64_t before, low, high, after;
} open_probes;

static open_probes read_open(const row_set *set, int32_t word) {
    return (open_probes){open_word(set, 2 * word - 1), open_word(set, 2 * word), open_word(set, 2 * word + 1),
                         open_word(set, 2 * word + 2)};
}

/* Parent i from probes 2i and 2i+1, for parents that stand between them. */
static uint64_t of_nearest(const open_probes *p) {
    return join_pairs(p->low) | join_pairs(p->high) << (DPL_MASK_BITS / 2);
}

/* Parent i as the lower of two: from probes 2i+1 and 2i+2. */
static uint64_t of_lower(const open_probes *p) {
    const int top = DPL_MASK_BITS - 1;
    return join_pairs(p->low >> 1 | p->high << top) | join_pairs(p->high >> 1 | p->after << top)
                                                          << (DPL_MASK_BITS / 2);
}

/* Parent i as the upper of two: from probes 2i-1 and 2i. */
static uint64_t of_upper(const open_probes *p) {
    const int top = DPL_MASK_BITS - 1;
    return join_pairs(p->low << 1 | p->before >> top) | join_pairs(p->high << 1 | p->low >> top)
                                                            << (DPL_MASK_BITS / 2);
}

/* At the border of the picture the nearest parent stands in for one that is missing. */
static uint64_t at_left_border(const open_probes *p, int32_t word) {
    return word == 0 ? p->low & 1 : 0;
}

static uint64_t at_right_border(const row_set *set, int32_t word, int32_t parents) {
    int32_t last_child = 2 * parents - 1;
    bool there = word == (parents - 1) / DPL_MASK_BITS && last_child < set->level->plan->probes_x &&
                 (open_word(set, last_child / DPL_MASK_BITS) >> last_child % DPL_MASK_BITS & 1);
    return there ? (uint64_t)1 << (parents - 1) % DPL_MASK_BITS : 0;
}

static uint64_t needed_by(const row_set *set, int32_t word, int32_t parents, bool lower, bool upper) {
    open_probes p = read_open(set, word);
    uint64_t found = 0;
    if (lower)
        found |= of_lower(&p) | at_left_border(&p, word);
    if (upper)
        found |= of_upper(&p) | at_right_border(set, word, parents);
    return lower || upper ? found : of_nearest(&p);
}

/* Adds the rows whose parent, `upper` of the two around them, is `row`. */
static void add_rows(row_set *set, int32_t row, int32_t rows, int32_t upper) {
    int32_t last = 2 * row + 2 < set->level->plan->probes_y ? 2 * row + 2 : set->level->plan->probes_y - 1;
    for (int32_t y = row > 0 ? 2 * row - 1 : 0; y <= last; y++)
        if (dpl_clamp_index(dpl_lower_parent(y) + upper, rows) == row &&
            (set->count == 0 || set->rows[set->count - 1] < y))
            set->rows[set->count++] = y;
}

/* One word of a row of parents. */
static uint64_t needed_word(const dpl_survey_task *t, int32_t slot, int32_t row, int32_t word) {
    const dpl_survey_level *below = t->below;
    int32_t rows = t->level->plan->probes_y, parents = t->level->plan->probes_x;
    row_set set = {.level = below, .ray = slot};
    uint64_t found = 0;
    if (below->merge == DPL_MERGE_BILINEAR_FIX) {
        for (set.aim = 0; set.aim < 4; set.aim++) {
            set.count = 0;
            add_rows(&set, row, rows, set.aim >> 1);
            found |= needed_by(&set, word, parents, !(set.aim & 1), set.aim & 1);
        }
        return found;
    }
    bool nearest = below->merge == DPL_MERGE_NEAREST_FIX;
    for (int32_t y = nearest || row == 0 ? 2 * row : 2 * row - 1; y <= 2 * row + (nearest ? 1 : 2); y++)
        if (y < below->plan->probes_y)
            set.rows[set.count++] = y;
    return needed_by(&set, word, parents, !nearest, !nearest);
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
        for (int32_t w = 0; w < level->needed.words; w++)
            needed[w] = needed_word(t, slot, row, w) & dpl_mask_all(&level->needed, w);
    }
}
