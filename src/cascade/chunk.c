/* What the rays of a slot see, for a run of probes in a row: march them over their interval, or look up what
 * they hit, put the level above behind what they let through, and add it up. Called by level.c.
 *
 * Four rays of every probe of a chunk are marched at once, for the more there are the fuller the vectors
 * stay: all of a slot, or, with the bilinear fix, one direction's to its four parents.
 *
 * With a fix merge a ray does not end at a fixed distance but where its parent's own interval begins, so that
 * the two join without a seam (Osborne and Sannikov 2024). */
#include "cascade/chunk.h"

#include "cascade/aim.h"
#include "cascade/survey.h"

static const double PI = 3.14159265358979323846;

/* Are all hits of the level looked up? Then no ray of it is aimed. */
static bool hits_are_known(const dpl_level *level) {
    return level->survey && level->survey->stored;
}

void dpl_chunk_prepare(const dpl_level *level, dpl_chunk *k) {
    bool to_parents = level->above && level->merge != DPL_MERGE_BILINEAR;
    for (int c = 0; c < 3; c++)
        memset(k->sum[c], 0, (size_t)k->count * sizeof k->sum[c][0]);
    if (hits_are_known(level))
        return;
    for (int32_t i = 0; i < k->count; i++)
        k->x[i] = dpl_probe_position(level->plan, k->first + i);
    for (int32_t i = 0; i < k->count && to_parents; i++) {
        int32_t lower = dpl_lower_parent(k->first + i), width = level->above->probes_x;
        k->parent_x[0][i] = dpl_probe_position(level->above, dpl_clamp_index(lower, width));
        k->parent_x[1][i] = dpl_probe_position(level->above, dpl_clamp_index(lower + 1, width));
    }
}

/* ---- rays ----------------------------------------------------------------------------------------- */

static void march(const dpl_level *level, dpl_chunk *k, int32_t count, int64_t *rays) {
    dpl_segments segments = {count, k->x0, k->y0, k->x1, k->y1};
    dpl_intervals intervals = {{k->radiance[0], k->radiance[1], k->radiance[2]},
                               {k->transmittance[0], k->transmittance[1], k->transmittance[2]}};
    level->march(&level->grid, &segments, &intervals);
    *rays += count;
}

/* Rays of a run all have the same share of their slot. */
static void share_evenly(dpl_chunk *k, const dpl_ray_group *group) {
    k->shares[0] = k->shares[1] = group->share;
}

/* ---- rays of a surveyed level --------------------------------------------------------------------- */

/* What rays that hit nothing gather. */
static void gather_nothing(dpl_chunk *k, int32_t count) {
    for (int c = 0; c < 3; c++)
        for (int32_t i = 0; i < count; i++) {
            k->radiance[c][i] = 0.0f;
            k->transmittance[c][i] = 1.0f;
        }
}

/* Numbers of the live rays of so many runs, which have the same probes live; returns how many. */
static int32_t list_live(const dpl_chunk *k, int32_t runs, int32_t index[DPL_CHUNK_BATCH]) {
    int32_t count = 0;
    for (int32_t run = 0; run < runs; run++)
        for (int32_t w = 0; w < DPL_CHUNK_WORDS; w++)
            for (uint64_t live = k->live[w]; live; live &= live - 1)
                index[count++] = run * k->count + w * DPL_MASK_BITS + dpl_bit_lowest(live);
    return count;
}

/* Marches the live rays alone; the others hit nothing, or nobody asks. */
static void march_live(const dpl_level *level, dpl_chunk *k, int32_t runs, int64_t *rays) {
    float ends[4][DPL_CHUNK_BATCH], found[6][DPL_CHUNK_BATCH];
    int32_t index[DPL_CHUNK_BATCH], count = list_live(k, runs, index);
    for (int32_t j = 0; j < count; j++) {
        ends[0][j] = k->x0[index[j]];
        ends[1][j] = k->y0[index[j]];
        ends[2][j] = k->x1[index[j]];
        ends[3][j] = k->y1[index[j]];
    }
    gather_nothing(k, runs * k->count);
    dpl_segments segments = {count, ends[0], ends[1], ends[2], ends[3]};
    dpl_intervals intervals = {{found[0], found[1], found[2]}, {found[3], found[4], found[5]}};
    level->march(&level->grid, &segments, &intervals);
    for (int c = 0; c < 3; c++)
        for (int32_t j = 0; j < count; j++) {
            k->radiance[c][index[j]] = found[c][j];
            k->transmittance[c][index[j]] = found[3 + c][j];
        }
    *rays += count;
}

/* Looks up what the survey knows of one ray of the chunk. */
static void find_hits(const dpl_survey_level *survey, dpl_chunk *k, int32_t ray, int32_t aim) {
    const uint64_t *hits = dpl_mask_row(&survey->hits, ray * survey->aims + aim, k->row);
    int32_t first = k->first / DPL_MASK_BITS;
    for (int32_t w = 0; w < DPL_CHUNK_WORDS; w++)
        k->hits[w] = first + w < survey->hits.words ? hits[first + w] : 0;
}

/* ---- rays, whoever traces them -------------------------------------------------------------------- */

/* Aims a run of rays: they begin at their probe, t0 along the way, and end t1 along it from `target_x` and
 * `target_y`, which are the probe itself or a parent. */
static void aim_run(const dpl_level *level, dpl_chunk *k, int32_t run, const dpl_ray_group *group,
                    const float *target_x, float target_y) {
    int32_t at = run * k->count;
    float *const ends[4] = {k->x0 + at, k->y0 + at, k->x1 + at, k->y1 + at};
    float t0 = (float)level->plan->t0, t1 = (float)level->plan->t1;
    float dx = group->direction[0], dy = group->direction[1];
    const float start[2] = {dx * t0, dpl_probe_position(level->plan, k->row) + dy * t0};
    const float end[2] = {dx * t1, target_y + dy * t1};
    level->kernels->aim_row(k->count, ends, k->x, start, target_x, end);
}

/* Finds what is on the way of the first runs. */
static void march_runs(const dpl_level *level, dpl_chunk *k, int32_t runs, int64_t *rays) {
    if (level->survey || level->dirt)
        march_live(level, k, runs, rays);
    else
        march(level, k, runs * k->count, rays);
}

/* Turns to what was found on the way of one run, or is known. In the order in which the survey has them. */
static void take_run(const dpl_level *level, dpl_chunk *k, int32_t run, const dpl_ray_group *group,
                     int32_t aim) {
    k->at = run * k->count;
    if (hits_are_known(level))
        find_hits(level->survey, k, group->first_slot, aim);
}

/* All of a slot's rays over their interval as it is. */
static void march_straight(const dpl_level *level, dpl_chunk *k, const dpl_ray_group groups[DPL_CHUNK_RUNS],
                           int32_t count, int64_t *rays) {
    if (hits_are_known(level))
        return;
    for (int32_t g = 0; g < count; g++)
        aim_run(level, k, g, &groups[g], k->x, dpl_probe_position(level->plan, k->row));
    march_runs(level, k, count, rays);
}

/* Does any of them let light through to where somebody asks? */
static bool sees_beyond(const dpl_level *level, const dpl_chunk *k) {
    bool sees = !hits_are_known(level);
    for (int32_t w = 0; w < DPL_CHUNK_WORDS && !sees; w++)
        sees = (k->needed[w] & ~k->hits[w]) != 0;
    return sees;
}

/* Adds what rays see where they end at opaque pixels. */
static void add_hits(const dpl_level *level, dpl_chunk *k) {
    for (int32_t w = 0; w < DPL_CHUNK_WORDS; w++)
        for (uint64_t hits = k->hits[w]; hits; hits &= hits - 1) {
            const float *emission = level->grid.emission[*k->cells++];
            int32_t i = w * DPL_MASK_BITS + dpl_bit_lowest(hits);
            for (int c = 0; c < 3; c++)
                k->sum[c][i] += k->shares[i % 2] * emission[c];
        }
}

/* Adds what was gathered, and behind it what the parents see, to the slot. A ray that hit nothing gathered 0
 * and lets all through: 0 + 1 * beyond is beyond. One that hit lets nothing through: emission + 0 * beyond is
 * emission. So neither needs to be computed, and the sum has the same bits. */
static void add_light(const dpl_level *level, dpl_chunk *k, const dpl_parents *parents) {
    const dpl_probe_sums sums = {k->count, {k->sum[0], k->sum[1], k->sum[2]}, {k->shares[0], k->shares[1]}};
    if (hits_are_known(level)) {
        level->kernels->merge_hits(&sums, parents, k->hits);
        add_hits(level, k);
        return;
    }
    dpl_intervals rays;
    for (int c = 0; c < 3; c++) {
        rays.radiance[c] = k->radiance[c] + k->at;
        rays.transmittance[c] = k->transmittance[c] + k->at;
    }
    level->kernels->merge(&sums, parents, &rays);
}

/* ---- the three merges, and the top ---------------------------------------------------------------- */

/* A row above in one slot, from the left parent of the chunk's first probe on. */
static const float *parents_of(const dpl_level *level, const dpl_chunk *k, int32_t slot, int32_t row) {
    return level->radiance_above + dpl_level_row(level->above, slot, 0, row) + dpl_lower_parent(k->first);
}

/* The mean of a row above over the slots that a group reads. */
static void average_parents(const dpl_level *level, const dpl_chunk *k, const dpl_ray_group *group,
                            int32_t row, float mean[3][DPL_CHUNK_PARENTS]) {
    size_t plane = dpl_level_stride(level->above);
    int32_t count = k->count / 2 + 2;
    for (int32_t s = 0; s < group->slot_count; s++) {
        const float *parents = parents_of(level, k, group->first_slot + s, row);
        for (size_t c = 0; c < 3; c++)
            level->kernels->add_scaled(count, mean[c], parents + c * plane, 1.0f / (float)group->slot_count,
                                       s > 0);
    }
}

/* A row of parents as a run of rays sees it: of the one slot that its group reads, or the mean over them. */
static const float *row_above(const dpl_level *level, dpl_chunk *k, const dpl_ray_group *group, int32_t row,
                              int32_t which) {
    if (group->slot_count == 1)
        return parents_of(level, k, group->first_slot, row);
    average_parents(level, k, group, row, k->mean[which]);
    return k->mean[which][0];
}

static ptrdiff_t plane_above(const dpl_level *level, const dpl_ray_group *group) {
    return group->slot_count == 1 ? (ptrdiff_t)dpl_level_stride(level->above) : DPL_CHUNK_PARENTS;
}

static void trace_bilinear(const dpl_level *level, dpl_chunk *k, const dpl_ray_group groups[DPL_CHUNK_RUNS],
                           int32_t count, int64_t *rays) {
    int32_t lower = dpl_lower_parent(k->row), rows = level->above->probes_y;
    dpl_parents parents = {.seen = DPL_PARENTS_FOUR, .between = dpl_upper_share(k->row)};
    march_straight(level, k, groups, count, rays);
    for (int32_t g = 0; g < count; g++) {
        take_run(level, k, g, &groups[g], 0);
        share_evenly(k, &groups[g]);
        if (!sees_beyond(level, k)) {
            add_hits(level, k);
            continue;
        }
        parents.row = row_above(level, k, &groups[g], dpl_clamp_index(lower, rows), 0);
        parents.next_row = row_above(level, k, &groups[g], dpl_clamp_index(lower + 1, rows), 1);
        parents.plane = plane_above(level, &groups[g]);
        add_light(level, k, &parents);
    }
}

/* The light of one parent of each probe, all in one row. */
static void add_parent(const dpl_level *level, dpl_chunk *k, const dpl_ray_group *group, int32_t row,
                       dpl_parents_seen seen, int32_t skip) {
    if (!sees_beyond(level, k)) {
        add_hits(level, k);
        return;
    }
    const dpl_parents parents = {
        .seen = seen, .row = row_above(level, k, group, row, 0) + skip, .plane = plane_above(level, group)};
    add_light(level, k, &parents);
}

/* A ray's four parents, `aim` by `aim`: the right ones are odd, the lower ones from 2 on. */
static void trace_to_parents(const dpl_level *level, dpl_chunk *k, const dpl_ray_group *group,
                             int64_t *rays) {
    float share_x = dpl_upper_share(k->first), share_y = dpl_upper_share(k->row);
    int32_t row[2];
    for (int32_t below = 0; below < 2; below++)
        row[below] = dpl_clamp_index(dpl_lower_parent(k->row) + below, level->above->probes_y);
    if (!hits_are_known(level)) {
        for (int32_t aim = 0; aim < DPL_CHUNK_RUNS; aim++)
            aim_run(level, k, aim, group, k->parent_x[aim & 1],
                    dpl_probe_position(level->above, row[aim >> 1]));
        march_runs(level, k, DPL_CHUNK_RUNS, rays);
    }
    for (int32_t aim = 0; aim < DPL_CHUNK_RUNS; aim++) {
        int32_t right = aim & 1, below = aim >> 1;
        for (int32_t odd = 0; odd < 2; odd++)
            k->shares[odd] =
                (right != odd ? share_x : 1.0f - share_x) * (below ? share_y : 1.0f - share_y) * group->share;
        take_run(level, k, aim, group, aim);
        add_parent(level, k, group, row[below], DPL_PARENT_LEFT, right);
    }
}

static void trace_bilinear_fix(const dpl_level *level, dpl_chunk *k,
                               const dpl_ray_group groups[DPL_CHUNK_RUNS], int32_t count, int64_t *rays) {
    for (int32_t g = 0; g < count; g++)
        trace_to_parents(level, k, &groups[g], rays);
}

/* The nearest parent is the right one of an even probe, the left one of an odd probe: one place behind either
 * way. */
static void trace_nearest_fix(const dpl_level *level, dpl_chunk *k,
                              const dpl_ray_group groups[DPL_CHUNK_RUNS], int32_t count, int64_t *rays) {
    float parent_x[DPL_CHUNK];
    int32_t row = dpl_clamp_index(k->row / 2, level->above->probes_y);
    for (int32_t i = 0; i < k->count; i++)
        parent_x[i] = k->parent_x[(i + 1) % 2][i];
    if (!hits_are_known(level)) {
        for (int32_t g = 0; g < count; g++)
            aim_run(level, k, g, &groups[g], parent_x, dpl_probe_position(level->above, row));
        march_runs(level, k, count, rays);
    }
    for (int32_t g = 0; g < count; g++) {
        take_run(level, k, g, &groups[g], 0);
        share_evenly(k, &groups[g]);
        add_parent(level, k, &groups[g], row, DPL_PARENT_NEAREST, 0);
    }
}

/* Behind its end a ray of the top level sees the mean sky of its own slot of angles, or of its group's. */
static void trace_top(const dpl_level *level, dpl_chunk *k, const dpl_ray_group groups[DPL_CHUNK_RUNS],
                      int32_t count, int64_t *rays) {
    const double slot = 2.0 * PI / level->plan->directions;
    march_straight(level, k, groups, count, rays);
    for (int32_t g = 0; g < count; g++) {
        const dpl_ray_group *group = &groups[g];
        float sky[3];
        dpl_field_sky_mean(level->field, group->first_slot * slot,
                           (group->first_slot + group->slot_count) * slot, sky);
        take_run(level, k, g, group, 0);
        share_evenly(k, group);
        if (hits_are_known(level) && sky[0] == 0.0f && sky[1] == 0.0f && sky[2] == 0.0f) {
            add_hits(level, k);
            continue;
        }
        const dpl_parents parents = {.seen = DPL_PARENT_SAME, .row = sky, .plane = 1};
        add_light(level, k, &parents);
    }
}

typedef void trace_function(const dpl_level *level, dpl_chunk *k, const dpl_ray_group groups[DPL_CHUNK_RUNS],
                            int32_t count, int64_t *rays);

void dpl_chunk_trace(const dpl_level *level, dpl_chunk *k, const dpl_ray_group groups[DPL_CHUNK_RUNS],
                     int32_t count, int64_t *rays) {
    static trace_function *const by_merge[] = {
        [DPL_MERGE_BILINEAR] = trace_bilinear,
        [DPL_MERGE_BILINEAR_FIX] = trace_bilinear_fix,
        [DPL_MERGE_NEAREST_FIX] = trace_nearest_fix,
    };
    trace_function *trace = level->above ? by_merge[level->merge] : trace_top;
    trace(level, k, groups, count, rays);
}
