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
    float share_y = dpl_upper_share(k->row);
    bool to_parents = level->above && level->merge != DPL_MERGE_BILINEAR;
    for (int c = 0; c < 3; c++)
        memset(k->sum[c], 0, (size_t)k->count * sizeof k->sum[c][0]);
    for (int32_t i = 0; i < k->count && !hits_are_known(level); i++)
        k->x[i] = dpl_probe_position(level->plan, k->first + i);
    for (int32_t i = 0; i < k->count && to_parents; i++) {
        int32_t lower = dpl_lower_parent(k->first + i), width = level->above->probes_x;
        float share_x = dpl_upper_share(k->first + i);
        k->parent_x[0][i] = dpl_probe_position(level->above, dpl_clamp_index(lower, width));
        k->parent_x[1][i] = dpl_probe_position(level->above, dpl_clamp_index(lower + 1, width));
        k->weight[0][i] = (1.0f - share_x) * (1.0f - share_y);
        k->weight[1][i] = share_x * (1.0f - share_y);
        k->weight[2][i] = (1.0f - share_x) * share_y;
        k->weight[3][i] = share_x * share_y;
    }
}

/* ---- rays ----------------------------------------------------------------------------------------- */

static void offset_all(int32_t count, float *out, const float *from, float offset) {
    for (int32_t i = 0; i < count; i++)
        out[i] = from[i] + offset;
}

static void fill_all(int32_t count, float *out, float value) {
    for (int32_t i = 0; i < count; i++)
        out[i] = value;
}

/* Rays begin at their probe, t0 along the way. */
static void set_starts(const dpl_level *level, dpl_chunk *k, const float direction[2]) {
    float t0 = (float)level->plan->t0;
    offset_all(k->count, k->x0 + k->at, k->x, direction[0] * t0);
    fill_all(k->count, k->y0 + k->at, dpl_probe_position(level->plan, k->row) + direction[1] * t0);
}

/* They end t1 along the way from where `x` and `y` are: the probe itself, or a parent. */
static void set_ends(const dpl_level *level, dpl_chunk *k, const float direction[2], const float *x,
                     float y) {
    float t1 = (float)level->plan->t1;
    offset_all(k->count, k->x1 + k->at, x, direction[0] * t1);
    fill_all(k->count, k->y1 + k->at, y + direction[1] * t1);
}

static void march(const dpl_level *level, dpl_chunk *k, int32_t count, int64_t *rays) {
    dpl_segments segments = {count, k->x0, k->y0, k->x1, k->y1};
    dpl_intervals intervals = {{k->radiance[0], k->radiance[1], k->radiance[2]},
                               {k->transmittance[0], k->transmittance[1], k->transmittance[2]}};
    level->march(&level->grid, &segments, &intervals);
    *rays += count;
}

static void merge(const dpl_level *level, dpl_chunk *k) {
    for (int c = 0; c < 3; c++)
        level->kernels->merge(k->count, k->sum[c], k->radiance[c] + k->at, k->transmittance[c] + k->at,
                              k->beyond[c], k->shares);
}

/* ---- rays of a surveyed level --------------------------------------------------------------------- */

/* What rays that hit nothing gather. */
static void gather_nothing(dpl_chunk *k, int32_t count) {
    for (int c = 0; c < 3; c++) {
        fill_all(count, k->radiance[c], 0.0f);
        fill_all(count, k->transmittance[c], 1.0f);
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

/* Where a ray ends at an opaque pixel, that pixel is what is seen. */
static void put_hits(const dpl_level *level, dpl_chunk *k) {
    for (int32_t w = 0; w < DPL_CHUNK_WORDS; w++)
        for (uint64_t hits = k->hits[w]; hits; hits &= hits - 1) {
            const float *emission = level->grid.emission[*k->cells++];
            int32_t i = w * DPL_MASK_BITS + dpl_bit_lowest(hits);
            for (int c = 0; c < 3; c++)
                k->beyond[c][i] = emission[c];
        }
}

/* Looks up what the survey knows of one ray of the chunk. */
static void find_hits(const dpl_survey_level *survey, dpl_chunk *k, int32_t ray, int32_t aim) {
    const uint64_t *hits = dpl_mask_row(&survey->hits, ray * survey->aims + aim, k->row);
    int32_t first = k->first / DPL_MASK_BITS;
    for (int32_t w = 0; w < DPL_CHUNK_WORDS; w++)
        k->hits[w] = first + w < survey->hits.words ? hits[first + w] : 0;
}

/* ---- rays, whoever traces them -------------------------------------------------------------------- */

/* Aims a run of rays, t1 along the direction from `target_x` and `target_y`, which are the probe itself or a
 * parent. */
static void aim_run(const dpl_level *level, dpl_chunk *k, int32_t run, const dpl_ray_group *group,
                    const float *target_x, float target_y) {
    k->at = run * k->count;
    set_starts(level, k, group->direction);
    set_ends(level, k, group->direction, target_x, target_y);
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

/* Puts what is beyond behind what was gathered, and adds both to the slot. A ray that hit nothing gathered 0
 * and lets all through: 0 + 1 * beyond is beyond. One that hit lets nothing through: emission + 0 * beyond is
 * emission. So neither needs to be computed, and the sum has the same bits. */
static void add_light(const dpl_level *level, dpl_chunk *k) {
    if (!hits_are_known(level)) {
        merge(level, k);
        return;
    }
    put_hits(level, k);
    for (int c = 0; c < 3; c++)
        level->kernels->accumulate(k->count, k->sum[c], k->beyond[c], k->shares);
}

/* The same where nobody sees what is beyond, or that is black: all else would add 0. */
static void add_hits(const dpl_level *level, dpl_chunk *k) {
    for (int32_t w = 0; w < DPL_CHUNK_WORDS; w++)
        for (uint64_t hits = k->hits[w]; hits; hits &= hits - 1) {
            const float *emission = level->grid.emission[*k->cells++];
            int32_t i = w * DPL_MASK_BITS + dpl_bit_lowest(hits);
            for (int c = 0; c < 3; c++)
                k->sum[c][i] += k->shares[i] * emission[c];
        }
}

/* ---- the three merges, and the top ---------------------------------------------------------------- */

/* From the left parent of the first probe to the right one of the last, and of its odd neighbour if it is
 * even. */
static int32_t parent_count(const dpl_chunk *k) {
    return (k->count + 1) / 2 + 2;
}

/* Parents of the whole chunk in one channel of one slot, `upper` of the way from row_a to row_b. Beyond the
 * border the last parent stands in for those that are missing. */
static void read_parents(const dpl_level *level, const dpl_chunk *k, int32_t slot, int c, int32_t row_a,
                         int32_t row_b, float upper, float out[DPL_CHUNK_PARENTS]) {
    const float *a = level->radiance_above + dpl_level_row(level->above, slot, c, row_a);
    const float *b = level->radiance_above + dpl_level_row(level->above, slot, c, row_b);
    int32_t first = dpl_lower_parent(k->first), count = parent_count(k), width = level->above->probes_x;
    int32_t begin = first < 0 ? -first : 0, end = width - first < count ? width - first : count;
    for (int32_t i = begin; i < end; i++)
        out[i] = a[first + i] + (b[first + i] - a[first + i]) * upper;
    for (int32_t i = 0; i < begin; i++)
        out[i] = out[begin];
    for (int32_t i = end; i < count; i++)
        out[i] = out[end - 1];
}

/* Parents of the whole chunk, mean over the slots that a group reads. */
static void load_parents(const dpl_level *level, dpl_chunk *k, const dpl_ray_group *group, int32_t row_a,
                         int32_t row_b, float upper) {
    float scale = 1.0f / (float)group->slot_count, more[DPL_CHUNK_PARENTS];
    int32_t count = parent_count(k);
    for (int c = 0; c < 3; c++) {
        read_parents(level, k, group->first_slot, c, row_a, row_b, upper, k->parents[c]);
        if (group->slot_count == 1)
            continue;
        for (int32_t s = 1; s < group->slot_count; s++) {
            read_parents(level, k, group->first_slot + s, c, row_a, row_b, upper, more);
            for (int32_t i = 0; i < count; i++)
                k->parents[c][i] += more[i];
        }
        for (int32_t i = 0; i < count; i++)
            k->parents[c][i] *= scale;
    }
}

static void trace_bilinear(const dpl_level *level, dpl_chunk *k, const dpl_ray_group groups[DPL_CHUNK_RUNS],
                           int32_t count, int64_t *rays) {
    int32_t lower = dpl_lower_parent(k->row), rows = level->above->probes_y;
    march_straight(level, k, groups, count, rays);
    for (int32_t g = 0; g < count; g++) {
        take_run(level, k, g, &groups[g], 0);
        fill_all(k->count, k->shares, groups[g].share);
        if (!sees_beyond(level, k)) {
            add_hits(level, k);
            continue;
        }
        load_parents(level, k, &groups[g], dpl_clamp_index(lower, rows), dpl_clamp_index(lower + 1, rows),
                     dpl_upper_share(k->row));
        for (int c = 0; c < 3; c++)
            level->kernels->spread(k->count, k->beyond[c], k->parents[c]);
        add_light(level, k);
    }
}

/* The light of one parent of every probe of the chunk, all in one row of the level above. Even and odd probes
 * find theirs `even` and `odd` places behind the left parent of the even one. */
static void add_parent(const dpl_level *level, dpl_chunk *k, const dpl_ray_group *group, int32_t row_above,
                       int32_t even, int32_t odd) {
    if (!sees_beyond(level, k)) {
        add_hits(level, k);
        return;
    }
    load_parents(level, k, group, row_above, row_above, 0.0f);
    for (int c = 0; c < 3; c++)
        for (int32_t i = 0; i < k->count; i += 2) {
            k->beyond[c][i] = k->parents[c][i / 2 + even];
            k->beyond[c][i + 1] = k->parents[c][i / 2 + odd]; /* one too many at an odd end: there is room */
        }
    add_light(level, k);
}

/* A ray's four parents, `aim` by `aim`: the right ones are odd, the lower ones from 2 on. */
static void trace_to_parents(const dpl_level *level, dpl_chunk *k, const dpl_ray_group *group,
                             int64_t *rays) {
    int32_t row_above[2];
    for (int32_t below = 0; below < 2; below++)
        row_above[below] = dpl_clamp_index(dpl_lower_parent(k->row) + below, level->above->probes_y);
    if (!hits_are_known(level)) {
        for (int32_t aim = 0; aim < DPL_CHUNK_RUNS; aim++)
            aim_run(level, k, aim, group, k->parent_x[aim & 1],
                    dpl_probe_position(level->above, row_above[aim >> 1]));
        march_runs(level, k, DPL_CHUNK_RUNS, rays);
    }
    for (int32_t aim = 0; aim < DPL_CHUNK_RUNS; aim++) {
        int32_t right = aim & 1;
        for (int32_t i = 0; i < k->count; i++)
            k->shares[i] = k->weight[aim][i] * group->share;
        take_run(level, k, aim, group, aim);
        add_parent(level, k, group, row_above[aim >> 1], right, 1 + right);
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
    int32_t row_above = dpl_clamp_index(k->row / 2, level->above->probes_y);
    for (int32_t i = 0; i < k->count; i++)
        parent_x[i] = k->parent_x[(i + 1) % 2][i];
    if (!hits_are_known(level)) {
        for (int32_t g = 0; g < count; g++)
            aim_run(level, k, g, &groups[g], parent_x, dpl_probe_position(level->above, row_above));
        march_runs(level, k, count, rays);
    }
    for (int32_t g = 0; g < count; g++) {
        fill_all(k->count, k->shares, groups[g].share);
        take_run(level, k, g, &groups[g], 0);
        add_parent(level, k, &groups[g], row_above, 1, 1);
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
        fill_all(k->count, k->shares, group->share);
        if (hits_are_known(level) && sky[0] == 0.0f && sky[1] == 0.0f && sky[2] == 0.0f) {
            add_hits(level, k);
            continue;
        }
        for (int c = 0; c < 3; c++)
            fill_all(k->count, k->beyond[c], sky[c]);
        add_light(level, k);
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
