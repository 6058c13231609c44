/* One way to light one scene, and what its frames took. Used by main.c and report.c. */
#ifndef DPL_BENCH_TRIAL_H
#define DPL_BENCH_TRIAL_H

#include "../common/summary.h"
#include "../common/world.h"

typedef struct dpl_bench_method {
    const char *name;
    dpl_solver_kind kind;
    dpl_storage storage;
    dpl_resolution resolution;
    dpl_merge merge;
    dpl_skip_mode skip;
} dpl_bench_method;

typedef struct dpl_bench_trial {
    const dpl_bench_method *method;
    dpl_bench_world world;
    int32_t size; /* [px] */
    int32_t threads;
    dpl_isa isa; /* DPL_ISA_ALL: the best that there is */
    /* what was found */
    dpl_isa used;
    int32_t levels;
    int64_t memory_bytes; /* of the solver */
    double *times;        /* shape [2][capacity]: wall, then processor [ms] */
    int32_t capacity;
    int32_t count;          /* times so far */
    dpl_bench_summary wall; /* after dpl_bench_trial_finish() [ms] */
    dpl_bench_summary cpu;
} dpl_bench_trial;

/* Room for `capacity` times. Free with dpl_bench_trial_free(). */
bool dpl_bench_trial_prepare(dpl_bench_trial *trial, int32_t capacity, dpl_error *error);
void dpl_bench_trial_free(dpl_bench_trial *trial);

/* A turn: makes all that is needed, solves once unmeasured (memory is allocated, distances are found), then
 * `frames` times under the stopwatch. */
bool dpl_bench_trial_run(dpl_bench_trial *trial, int32_t frames, dpl_error *error);

/* Sums up the times, after the last turn. */
void dpl_bench_trial_finish(dpl_bench_trial *trial);

#endif
