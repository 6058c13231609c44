/* One level of a cascade while it is being solved. Filled by cascades.c, worked off by level.c. */
#ifndef DPL_CASCADE_LEVEL_H
#define DPL_CASCADE_LEVEL_H

#include "cascade/dirty.h"
#include "cascade/survey.h"
#include "solver/solver.h"

#include <dapple/schedule.h>

/* Slots of level 1 at the most: as many as level 0 may have directions. */
#define DPL_MOST_SLOTS_AT_ONE 1024

/* Radiance of a level is stored direction first: [slot][probe row][channel][probe]. A slot holds the mean
 * over the DPL_BRANCHING rays that it stands for (pre-averaging), so level n+1 has a slot for each ray of
 * level n. */
typedef struct dpl_level {
    const dpl_kernels *kernels;
    void (*march)(const dpl_grid *grid, const dpl_segments *segments, const dpl_intervals *intervals);
    const dpl_schedule_level *plan;
    const dpl_schedule_level *above; /* NULL at the top */
    dpl_merge merge;
    dpl_grid grid;
    const dpl_field *field;         /* its sky is what the top level's rays see behind their end */
    const float (*directions)[2];   /* cosine and sine in steps of half a ray: ray k points along 2k+1 */
    const float *radiance_above;    /* of the level above, NULL at the top */
    float *radiance;                /* of this level */
    dpl_ray_counter *counters;      /* per worker */
    int32_t number;                 /* which level this is */
    const int32_t *steps;           /* per level: rays that each traced one stands for (1, 2 or 4) */
    bool centred;                   /* it stands in the middle of them; else it is the first of them */
    const dpl_survey_level *survey; /* what is known of its rays before it is solved; NULL: nothing */
    bool drop_dead;                 /* leave out slots that no ray of the level below reads */
    const dpl_dirt *dirt; /* `radiance` is the last frame's, and only this is out of date; NULL: all of it */
} dpl_level;

/* Items of work in a level: one per slot and row of probes. */
int32_t dpl_level_items(const dpl_schedule_level *plan);

/* A dpl_task_function over those items; `task` is a dpl_level. */
void dpl_level_solve(int32_t begin, int32_t end, int32_t worker, void *task);

/* Some neighbouring rays of a slot that one traced ray stands for, and what that ray reads of the level
 * above. */
typedef struct dpl_ray_group {
    const float *direction;
    int32_t first_slot;
    int32_t slot_count;
    float share; /* of the slot */
} dpl_ray_group;

static inline dpl_ray_group dpl_level_group(const dpl_level *level, int32_t ray) {
    int32_t step = level->steps[level->number], read = level->centred ? step : 1;
    return (dpl_ray_group){level->directions[2 * ray + read], ray, read, (float)step / DPL_BRANCHING};
}

/* Rows are stored with their first and last value once more outside: beyond the border of the picture the
 * last probe stands in for those that are missing. */
static inline size_t dpl_level_stride(const dpl_schedule_level *plan) {
    return (size_t)plan->probes_x + 2;
}

/* Row of one channel in stored radiance. */
static inline size_t dpl_level_row(const dpl_schedule_level *plan, int32_t slot, int c, int32_t row) {
    size_t rows = (size_t)plan->probes_y;
    return (((size_t)slot * rows + (size_t)row) * 3 + (size_t)c) * dpl_level_stride(plan) + 1;
}

/* Values of all rows and their borders, and room behind them for kernels that read them as parents. */
static inline size_t dpl_level_values(const dpl_schedule_level *plan) {
    return (size_t)plan->slots * 3 * (size_t)plan->probes_y * dpl_level_stride(plan) + DPL_PARENTS_SPARE;
}

#endif
