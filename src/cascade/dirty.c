/* Which probes of a slot and row must be solved again. Called by level.c. */
#include "cascade/dirty.h"

#include "cascade/aim.h"
#include "cascade/level.h"

/* ---- rays near what has changed ------------------------------------------------------------------- */

static void add_range(uint64_t *dirty, int32_t first, int32_t last) {
    for (int32_t w = first / DPL_MASK_BITS; w * DPL_MASK_BITS < last; w++)
        dirty[w] |= dpl_mask_range(w * DPL_MASK_BITS, first, last);
}

static void add_rays(const dpl_level *level, const float direction[2], int32_t row, uint64_t *dirty) {
    for (int32_t i = 0; i < level->dirt->box_count; i++) {
        int32_t first, last;
        dpl_rays_near(level->plan, direction, row, &level->dirt->boxes[i], level->dirt->slack, &first, &last);
        if (first < last)
            add_range(dirty, first, last);
    }
}

/* ---- parents that have changed -------------------------------------------------------------------- */

/* Bits i of the lower half become bits 2i and 2i + 1. */
static uint64_t double_bits(uint64_t v) {
    v &= 0x00000000ffffffffu;
    v = (v | v << 16) & 0x0000ffff0000ffffu;
    v = (v | v << 8) & 0x00ff00ff00ff00ffu;
    v = (v | v << 4) & 0x0f0f0f0f0f0f0f0fu;
    v = (v | v << 2) & 0x3333333333333333u;
    v = (v | v << 1) & 0x5555555555555555u;
    return v | v << 1;
}

/* Parents that have changed, in any of the slots and rows that a ray reads. */
static uint64_t changed_word(const dpl_level *level, const dpl_ray_group *group, const int32_t rows[2],
                             int32_t word) {
    const dpl_mask *changed = &level->dirt->changed_above;
    uint64_t found = 0;
    if (word < 0 || word >= changed->words)
        return 0;
    for (int32_t s = group->first_slot; s < group->first_slot + group->slot_count; s++)
        found |= dpl_mask_row(changed, s, rows[0])[word] | dpl_mask_row(changed, s, rows[1])[word];
    return found;
}

/* Children 64 w .. 64 w + 63 of parents 32 w .. 32 w + 31. Where four parents are interpolated, a parent is
 * also read by the children before and after its own. */
static uint64_t children_word(const dpl_level *level, const dpl_ray_group *group, const int32_t rows[2],
                              int32_t w) {
    const int32_t half = DPL_MASK_BITS / 2;
    uint64_t parents = changed_word(level, group, rows, w / 2);
    uint64_t own = double_bits(w % 2 ? parents >> half : parents);
    if (level->merge == DPL_MERGE_NEAREST_FIX)
        return own;
    uint64_t before = w % 2 ? parents >> (half - 1) : changed_word(level, group, rows, w / 2 - 1) >> 63;
    uint64_t after = w % 2 ? changed_word(level, group, rows, w / 2 + 1) : parents >> half;
    return own | own << 1 | own >> 1 | (before & 1) | (after & 1) << 63;
}

static void add_children(const dpl_level *level, const dpl_ray_group *group, int32_t row, uint64_t *dirty) {
    int32_t rows_above = level->above->probes_y, lower = dpl_lower_parent(row);
    int32_t rows[2] = {dpl_clamp_index(lower, rows_above), dpl_clamp_index(lower + 1, rows_above)};
    if (level->merge == DPL_MERGE_NEAREST_FIX)
        rows[0] = rows[1] = dpl_clamp_index(row / 2, rows_above);
    for (int32_t w = 0; w < level->dirt->changed.words; w++)
        dirty[w] |= children_word(level, group, rows, w);
}

bool dpl_level_find_dirty(const dpl_level *level, int32_t slot, int32_t row,
                          uint64_t dirty[DPL_DIRTY_WORDS]) {
    const dpl_mask *changed = &level->dirt->changed;
    uint64_t any = 0;
    memset(dirty, 0, (size_t)(changed->words + DPL_CHUNK_WORDS) * sizeof *dirty);
    for (int32_t j = 0; j < DPL_BRANCHING; j += level->steps[level->number]) {
        dpl_ray_group group = dpl_level_group(level, slot * DPL_BRANCHING + j);
        add_rays(level, group.direction, row, dirty);
        if (level->above)
            add_children(level, &group, row, dirty);
    }
    for (int32_t w = 0; w < changed->words; w++)
        any |= dirty[w] &= dpl_mask_all(changed, w);
    return any != 0;
}
