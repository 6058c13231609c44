/* Trials in the plane: how the work grows with the number of shapes. Used by main.c and report.c. */
#ifndef DPL_BENCH_FLAT_H
#define DPL_BENCH_FLAT_H

#include "trial.h"

/* The sets of shapes. */
enum { DPL_BENCH_FLAT_SETS = 2 };
extern const char *const dpl_bench_flat_sets[DPL_BENCH_FLAT_SETS];

/* All worlds of shapes with their rays. Zero-initialise. */
typedef struct dpl_bench_flat {
    dpl_context *context;
    struct dpl_bench_flat_world *worlds;
    int32_t count;
    dpl_ray *rays;
    dpl_hit *hits; /* of the last run, whichever it was */
} dpl_bench_flat;

/* Adds a naive trial and one through a hierarchy for each set and number of shapes: 1, 2, 5, 10 .. `largest`.
 * The trials point into `flat`. */
bool dpl_bench_flat_prepare(dpl_bench_flat *flat, dpl_context *context, int32_t largest, int32_t rays,
                            int32_t builds, dpl_bench_trials *trials, dpl_error *error);

void dpl_bench_flat_free(dpl_bench_flat *flat);

#endif
