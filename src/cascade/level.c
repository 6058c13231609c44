/* Traces and merges one level: for a slot and a row of probes, march the slot's rays over their interval, put
 * the level above behind what they let through, and store the mean. Run by cascades.c, top level first.
 *
 * With skipping a slot's rays are traced in groups of 2 or 4: one ray stands for its group. Centred in it, it
 * sees the mean of the slots above that the group would have seen; the paper's takes the first ray and its
 * slot alone.
 *
 * With a fix merge a ray does not end at a fixed distance but where its parent's own interval begins, so that
 * the two join without a seam (Osborne and Sannikov 2024). */
#include "cascade/level.h"

/* Probes of a row handled at once: enough to fill vectors, few enough for the buffers to stay in cache. Even,
 * so that pairs of children with one parent are not cut. */
#define CHUNK 128
#define PARENTS (CHUNK / 2 + 2)

/* A run of probes in a row, and everything that is computed for it. */
typedef struct chunk {
    int32_t first; /* probe */
    int32_t count;
    int32_t row;
    float x0[CHUNK], y0[CHUNK], x1[CHUNK], y1[CHUNK];
    float radiance[3][CHUNK], transmittance[3][CHUNK];
    float beyond[3][CHUNK];
    float weight[CHUNK];
    float sum[3][CHUNK];
    float parents[3][PARENTS]; /* from the left parent of the first probe on */
} chunk;

static int32_t clamp_index(int32_t i, int32_t count) {
    return i < 0 ? 0 : i >= count ? count - 1 : i;
}

/* Which parents a probe lies between, in one axis: the lower one, and the share of the upper one. */
static int32_t lower_parent(int32_t probe) {
    return probe / 2 - (probe % 2 == 0);
}

static float upper_share(int32_t probe) {
    return probe % 2 == 0 ? 0.75f : 0.25f;
}

/* Some neighbouring rays of a slot that one traced ray stands for, and what that ray reads of the level
 * above. */
typedef struct ray_group {
    const float *direction;
    int32_t first_slot;
    int32_t slot_count;
    float share; /* of the slot */
} ray_group;

static ray_group group_from(const dpl_level *level, int32_t ray) {
    int32_t step = level->steps[level->number], read = level->centred ? step : 1;
    return (ray_group){level->directions[2 * ray + read], ray, read, (float)step / DPL_BRANCHING};
}

/* ---- rays -----------------------------------------------------------------------------------------------
 */

static float probe_position(const dpl_schedule_level *plan, int32_t probe) {
    return (float)((probe + 0.5) * plan->spacing);
}

static void set_starts(const dpl_level *level, chunk *k, const float direction[2]) {
    float from_x = (float)(direction[0] * level->plan->t0), from_y = (float)(direction[1] * level->plan->t0);
    float y = probe_position(level->plan, k->row) + from_y;
    for (int32_t i = 0; i < k->count; i++) {
        k->x0[i] = probe_position(level->plan, k->first + i) + from_x;
        k->y0[i] = y;
    }
}

static void set_ends_at_interval(const dpl_level *level, chunk *k, const float direction[2]) {
    float to_x = (float)(direction[0] * level->plan->t1), to_y = (float)(direction[1] * level->plan->t1);
    float y = probe_position(level->plan, k->row) + to_y;
    for (int32_t i = 0; i < k->count; i++) {
        k->x1[i] = probe_position(level->plan, k->first + i) + to_x;
        k->y1[i] = y;
    }
}

/* Ends where the interval of one of the four parents begins: `right` and `row_above` say which. */
static void set_ends_at_parent(const dpl_level *level, chunk *k, const float direction[2],
                               const int32_t *parent_x, int32_t row_above) {
    float to_x = (float)(direction[0] * level->plan->t1), to_y = (float)(direction[1] * level->plan->t1);
    float y = probe_position(level->above, row_above) + to_y;
    for (int32_t i = 0; i < k->count; i++) {
        k->x1[i] = probe_position(level->above, clamp_index(parent_x[i], level->above->probes_x)) + to_x;
        k->y1[i] = y;
    }
}

static void march(const dpl_level *level, chunk *k, int64_t *rays) {
    dpl_segments segments = {k->count, k->x0, k->y0, k->x1, k->y1};
    dpl_intervals intervals = {{k->radiance[0], k->radiance[1], k->radiance[2]},
                               {k->transmittance[0], k->transmittance[1], k->transmittance[2]}};
    level->march(&level->grid, &segments, &intervals);
    *rays += k->count;
}

static void merge(const dpl_level *level, chunk *k) {
    for (int c = 0; c < 3; c++)
        level->kernels->merge(k->count, k->sum[c], k->radiance[c], k->transmittance[c], k->beyond[c],
                              k->weight);
}

static void set_weight(chunk *k, float weight) {
    for (int32_t i = 0; i < k->count; i++)
        k->weight[i] = weight;
}

/* ---- the three merges, and the top ----------------------------------------------------------------------
 */

/* Parents of the whole chunk, mean over the slots that a group reads, `upper` of the way from row_a to row_b.
 */
static void load_parents(const dpl_level *level, chunk *k, const ray_group *group, int32_t row_a,
                         int32_t row_b, float upper) {
    int32_t first = lower_parent(k->first), width = level->above->probes_x;
    int32_t count = k->count / 2 + 2;
    for (int c = 0; c < 3; c++) {
        for (int32_t s = 0; s < group->slot_count; s++) {
            const float *a =
                level->radiance_above + dpl_level_row(level->above, group->first_slot + s, c, row_a);
            const float *b =
                level->radiance_above + dpl_level_row(level->above, group->first_slot + s, c, row_b);
            for (int32_t i = 0; i < count; i++) {
                int32_t at = clamp_index(first + i, width);
                float value = a[at] + (b[at] - a[at]) * upper;
                k->parents[c][i] = s == 0 ? value : k->parents[c][i] + value;
            }
        }
        float scale = 1.0f / (float)group->slot_count;
        for (int32_t i = 0; i < count && group->slot_count > 1; i++)
            k->parents[c][i] *= scale;
    }
}

static void trace_bilinear(const dpl_level *level, chunk *k, const ray_group *group, int64_t *rays) {
    int32_t lower = lower_parent(k->row), rows = level->above->probes_y;
    set_starts(level, k, group->direction);
    set_ends_at_interval(level, k, group->direction);
    march(level, k, rays);
    load_parents(level, k, group, clamp_index(lower, rows), clamp_index(lower + 1, rows),
                 upper_share(k->row));
    for (int c = 0; c < 3; c++)
        level->kernels->spread(k->count, k->beyond[c], k->parents[c]);
    set_weight(k, group->share);
    merge(level, k);
}

/* One parent of every probe of the chunk, all in one row of the level above. */
static void trace_to_parent(const dpl_level *level, chunk *k, const ray_group *group, const int32_t *parent_x,
                            int32_t row_above, int64_t *rays) {
    int32_t first = lower_parent(k->first);
    row_above = clamp_index(row_above, level->above->probes_y);
    set_starts(level, k, group->direction);
    set_ends_at_parent(level, k, group->direction, parent_x, row_above);
    march(level, k, rays);
    load_parents(level, k, group, row_above, row_above, 0.0f);
    for (int c = 0; c < 3; c++)
        for (int32_t i = 0; i < k->count; i++)
            k->beyond[c][i] = k->parents[c][parent_x[i] - first];
    merge(level, k);
}

static void trace_bilinear_fix(const dpl_level *level, chunk *k, const ray_group *group, int64_t *rays) {
    for (int b = 0; b < 4; b++) {
        int right = b & 1, below = b >> 1;
        int32_t parent_x[CHUNK];
        float share_y = upper_share(k->row);
        float weight_y = (below ? share_y : 1.0f - share_y) * group->share;
        for (int32_t i = 0; i < k->count; i++) {
            float share_x = upper_share(k->first + i);
            parent_x[i] = lower_parent(k->first + i) + right;
            k->weight[i] = (right ? share_x : 1.0f - share_x) * weight_y;
        }
        trace_to_parent(level, k, group, parent_x, lower_parent(k->row) + below, rays);
    }
}

static void trace_nearest_fix(const dpl_level *level, chunk *k, const ray_group *group, int64_t *rays) {
    int32_t parent_x[CHUNK];
    for (int32_t i = 0; i < k->count; i++)
        parent_x[i] = (k->first + i) / 2;
    set_weight(k, group->share);
    trace_to_parent(level, k, group, parent_x, k->row / 2, rays);
}

static void trace_top(const dpl_level *level, chunk *k, const ray_group *group, int64_t *rays) {
    set_starts(level, k, group->direction);
    set_ends_at_interval(level, k, group->direction);
    march(level, k, rays);
    for (int c = 0; c < 3; c++)
        for (int32_t i = 0; i < k->count; i++)
            k->beyond[c][i] = level->sky[c];
    set_weight(k, group->share);
    merge(level, k);
}

typedef void trace_function(const dpl_level *level, chunk *k, const ray_group *group, int64_t *rays);

static trace_function *trace_of(const dpl_level *level) {
    static trace_function *const by_merge[] = {
        [DPL_MERGE_BILINEAR] = trace_bilinear,
        [DPL_MERGE_BILINEAR_FIX] = trace_bilinear_fix,
        [DPL_MERGE_NEAREST_FIX] = trace_nearest_fix,
    };
    return level->above ? by_merge[level->merge] : trace_top;
}

/* ---- work -----------------------------------------------------------------------------------------------
 */

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

static int64_t solve_row(const dpl_level *level, int32_t slot, int32_t row) {
    trace_function *trace = trace_of(level);
    int64_t rays = 0;
    chunk k;
    k.row = row;
    for (k.first = 0; k.first < level->plan->probes_x; k.first += CHUNK) {
        int32_t left = level->plan->probes_x - k.first;
        k.count = left < CHUNK ? left : CHUNK;
        memset(k.sum, 0, sizeof k.sum);
        for (int32_t j = 0; j < DPL_BRANCHING; j += level->steps[level->number]) {
            ray_group group = group_from(level, slot * DPL_BRANCHING + j);
            trace(level, &k, &group, &rays);
        }
        for (int c = 0; c < 3; c++)
            memcpy(level->radiance + dpl_level_row(level->plan, slot, c, row) + k.first, k.sum[c],
                   (size_t)k.count * sizeof(float));
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
