/* One situation under a stopwatch, with a solver that keeps frames and one that does not. Called by main.c.
 */
#ifndef DPL_BENCH_REUSE_MEASURE_H
#define DPL_BENCH_REUSE_MEASURE_H

#include "situation.h"

#include <dapple/solver.h>

typedef struct dpl_bench_method {
    const char *name;
    dpl_solver_kind kind;
    dpl_merge merge;
} dpl_bench_method;

enum { DPL_BENCH_ANEW, DPL_BENCH_REUSE, DPL_BENCH_WAYS };

/* Over all frames but the first. */
typedef struct dpl_bench_row {
    const dpl_bench_situation *situation;
    const dpl_bench_method *method;
    int32_t size;
    double cpu_ms[DPL_BENCH_WAYS];  /* the least */
    double most_ms[DPL_BENCH_WAYS]; /* the greatest */
    int64_t rays[DPL_BENCH_WAYS];   /* of a frame, mean */
    int64_t memory[DPL_BENCH_WAYS]; /* [byte] */
    bool equal;                     /* every frame, to the bit */
} dpl_bench_row;

/* Fills a row whose first three members are set. */
bool dpl_bench_reuse_measure(dpl_context *context, int32_t frames, dpl_bench_row *row, dpl_error *error);

#endif
