/* Everything that is measured: tracers over discs of chance, floods lit by one lamp, and the list of cases
 * over them. Used by measure.c and complexity.c. */
#ifndef DPL_COMPLEXITY_WORLDS_H
#define DPL_COMPLEXITY_WORLDS_H

#include "case.h"

#include <dapple/dapple.h>

#define DPL_COMPLEXITY_CASES_MAX 256
#define DPL_COMPLEXITY_TRACERS_MAX 80
#define DPL_COMPLEXITY_FLOODS_MAX 8

/* Rays in a run: the factor r. */
enum { DPL_COMPLEXITY_RAY_COUNTS = 5 };
extern const int32_t dpl_complexity_ray_counts[DPL_COMPLEXITY_RAY_COUNTS];

/* Zero-initialise. */
typedef struct dpl_complexity_worlds {
    const dpl_complexity_plan *plan;
    dpl_context *context;
    dpl_tracer *tracers[DPL_COMPLEXITY_TRACERS_MAX];
    int32_t tracer_count;
    dpl_flood *floods[DPL_COMPLEXITY_FLOODS_MAX];
    int32_t flood_count;
    dpl_ray *rays; /* the first ones of every run */
    dpl_hit *hits; /* of the last run */
    dpl_complexity_case *cases;
    int32_t case_count;
} dpl_complexity_worlds;

/* Makes it all. Destroy it whatever comes back; the context, where there is one, says what was wrong. */
dpl_status dpl_complexity_worlds_create(const dpl_complexity_plan *plan, dpl_complexity_worlds *worlds);

void dpl_complexity_worlds_destroy(dpl_complexity_worlds *worlds);

/* The case of the growth part with this method, size and number of rays, or NULL. */
const dpl_complexity_case *dpl_complexity_find(const dpl_complexity_worlds *worlds,
                                               dpl_complexity_method method, int32_t size, int32_t rays);

#endif
