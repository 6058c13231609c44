/* Solves one level: for every slot and row of probes, chunk by chunk, traces what somebody asks for and
 * stores the mean. Run by cascades.c, top level first.
 *
 * With skipping a slot's rays are traced in groups of 2 or 4: one ray stands for its group. Centred in it, it
 * sees the mean of the slots above that the group would have seen; the paper's takes the first ray and its
 * slot alone. */
#include "cascade/level.h"

#include "cascade/chunk.h"
#include "cascade/survey.h"

int32_t dpl_level_items(const dpl_schedule_level *plan) {
    return plan->slots * plan->probes_y;
}

/* Is a slot read, through the levels below, by anything that reaches level 0? Where the first ray of a group
 * stands for it, the slots of the others are not. */
static bool slot_is_read(const dpl_level *level, int32_t slot) {
    for (int32_t below = level->number - 1; below >= 0; below--) {
        if (slot % DPL_BRANCHING % level->steps[below] != 0)
            return false;
        slot /= DPL_BRANCHING;
    }
    return true;
}

/* Looks up what the survey knows of a slot and chunk. False when nobody asks for any of it. */
static bool look_up_chunk(const dpl_survey_level *survey, dpl_chunk *k, int32_t slot) {
    int32_t first = k->first / DPL_MASK_BITS;
    uint64_t any = 0;
    for (int32_t w = 0; w < DPL_CHUNK_WORDS; w++) {
        bool there = first + w < survey->needed.words;
        k->needed[w] = there ? dpl_mask_row(&survey->needed, slot, k->row)[first + w] : 0;
        k->live[w] = there ? dpl_mask_row(&survey->live, slot, k->row)[first + w] : 0;
        any |= k->needed[w];
    }
    if (survey->stored)
        k->cells = survey->cells + *dpl_survey_cells_at(survey, slot, k->row, k->first / DPL_CHUNK);
    return any != 0;
}

/* The first probe from `first` on that is out of date, or the end of the row. */
static int32_t next_dirty(const uint64_t dirty[DPL_DIRTY_WORDS], int32_t first, int32_t probes) {
    for (int32_t w = first / DPL_MASK_BITS; w * DPL_MASK_BITS < probes; w++) {
        uint64_t left = dirty[w] & dpl_mask_range(w * DPL_MASK_BITS, first, probes);
        if (left)
            return w * DPL_MASK_BITS + dpl_bit_lowest(left);
    }
    return probes;
}

/* From the first to the last of a chunk's probes that are out of date, which become the live ones. */
static void cut_to_dirt(dpl_chunk *k, const uint64_t dirty[DPL_DIRTY_WORDS]) {
    int32_t word = k->first / DPL_MASK_BITS, shift = k->first % DPL_MASK_BITS, end = 0;
    for (int32_t w = 0; w < DPL_CHUNK_WORDS; w++) {
        k->live[w] = dirty[word + w] >> shift;
        if (shift > 0)
            k->live[w] |= dirty[word + w + 1] << (DPL_MASK_BITS - shift);
        if (k->live[w])
            end = w * DPL_MASK_BITS + dpl_mask_end(k->live[w]);
    }
    k->count = end;
}

/* The next chunk of a row from probe `first` on; false at its end. */
static bool next_chunk(const dpl_level *level, dpl_chunk *k, int32_t first,
                       const uint64_t dirty[DPL_DIRTY_WORDS]) {
    int32_t probes = level->plan->probes_x, probe = level->dirt ? next_dirty(dirty, first, probes) : first;
    if (probe >= probes)
        return false;
    k->first = probe / 2 * 2;
    k->count = probes - k->first < DPL_CHUNK ? probes - k->first : DPL_CHUNK;
    if (level->dirt)
        cut_to_dirt(k, dirty);
    return true;
}

/* Stores what was out of date in a chunk, and notes what that has changed. */
static void store_dirty(const dpl_level *level, const dpl_chunk *k, int32_t slot, float *const rows[3]) {
    uint64_t *changed = dpl_mask_row(&level->dirt->changed, slot, k->row);
    for (int32_t w = 0; w < DPL_CHUNK_WORDS; w++)
        for (uint64_t live = k->live[w]; live; live &= live - 1) {
            int32_t i = w * DPL_MASK_BITS + dpl_bit_lowest(live), probe = k->first + i;
            for (int c = 0; c < 3; c++) {
                if (memcmp(&rows[c][probe], &k->sum[c][i], sizeof(float)) != 0)
                    changed[probe / DPL_MASK_BITS] |= (uint64_t)1 << probe % DPL_MASK_BITS;
                rows[c][probe] = k->sum[c][i];
            }
        }
}

/* Stores the chunk, and the row's border where it touches it. */
static void store(const dpl_level *level, const dpl_chunk *k, int32_t slot) {
    float *rows[3];
    int32_t behind = level->plan->probes_x;
    for (int c = 0; c < 3; c++)
        rows[c] = level->radiance + dpl_level_row(level->plan, slot, c, k->row);
    if (level->dirt)
        store_dirty(level, k, slot, rows);
    for (int c = 0; c < 3; c++) {
        if (!level->dirt)
            memcpy(rows[c] + k->first, k->sum[c], (size_t)k->count * sizeof(float));
        if (k->first == 0)
            rows[c][-1] = rows[c][0];
        if (k->first + k->count == behind)
            rows[c][behind] = rows[c][behind - 1];
    }
}

static int64_t solve_row(const dpl_level *level, int32_t slot, int32_t row) {
    int64_t rays = 0;
    dpl_chunk k;
    uint64_t dirty[DPL_DIRTY_WORDS];
    dpl_ray_group groups[DPL_CHUNK_RUNS];
    int32_t step = level->steps[level->number], count = DPL_BRANCHING / step;
    if (level->dirt && !dpl_level_find_dirty(level, slot, row, dirty))
        return 0;
    for (int32_t g = 0; g < count; g++)
        groups[g] = dpl_level_group(level, slot * DPL_BRANCHING + g * step);
    k.row = row;
    for (int32_t first = 0; next_chunk(level, &k, first, dirty); first = k.first + DPL_CHUNK) {
        if (level->survey && !look_up_chunk(level->survey, &k, slot))
            continue;
        dpl_chunk_prepare(level, &k);
        dpl_chunk_trace(level, &k, groups, count, &rays);
        store(level, &k, slot);
    }
    return rays;
}

void dpl_level_solve(int32_t begin, int32_t end, int32_t worker, void *task) {
    const dpl_level *level = task;
    int64_t rays = 0;
    for (int32_t item = begin; item < end; item++) {
        int32_t slot = item / level->plan->probes_y;
        if (!level->drop_dead || slot_is_read(level, slot))
            rays += solve_row(level, slot, item % level->plan->probes_y);
    }
    level->counters[worker].rays += rays;
}
