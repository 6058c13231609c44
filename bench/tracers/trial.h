/* One thing that is timed again and again: rays of one kind through one structure by one method. Made by
 * flat.c, solid.c and frame.c, run by main.c, read by report.c. */
#ifndef DPL_BENCH_TRIAL_H
#define DPL_BENCH_TRIAL_H

#include "../../image/error.h"
#include "../common/summary.h"

#include <dapple/dapple.h>

#define DPL_BENCH_MAX_ROUNDS 99

typedef struct dpl_bench_trial dpl_bench_trial;

struct dpl_bench_trial {
    const char *part;   /* "flat", "solid" or "frame" */
    const char *set;    /* of objects and rays */
    const char *query;  /* what is asked */
    const char *method; /* who answers */
    int32_t objects;
    int64_t rays; /* per run */
    int64_t hits; /* of them */
    dpl_bench_summary build_ms;
    /* Counted by the tracer; 0 where nobody counts. */
    double tests_per_ray;
    double visits_per_ray;
    /* Does all of it once. The subject belongs to whoever made the trial. */
    bool (*run)(dpl_bench_trial *trial, dpl_error *error);
    void *subject;
    double ns[DPL_BENCH_MAX_ROUNDS]; /* processor time per ray of each round */
    dpl_bench_summary summary;       /* of ns, after the last round */
    int32_t runs;                    /* so far */
};

/* A list that grows. Zero-initialise; trials do not move once all are added. */
typedef struct dpl_bench_trials {
    dpl_bench_trial *trials;
    int32_t count;
    int32_t capacity;
} dpl_bench_trials;

/* The new trial, zeroed; NULL and an error without memory. */
dpl_bench_trial *dpl_bench_trials_add(dpl_bench_trials *list, dpl_error *error);

void dpl_bench_trials_free(dpl_bench_trials *list);

/* Runs all trials in turn, once without a stopwatch and `rounds` times with: when the machine is slower for a
 * while, it is so for all of them. */
bool dpl_bench_trials_run(dpl_bench_trials *list, int32_t rounds, dpl_error *error);

/* Keeps a tracer's counters since its last reset and resets them. False when they are not those of the
 * trial's run before: counters must repeat. */
bool dpl_bench_trial_count(dpl_bench_trial *trial, dpl_tracer *tracer, dpl_error *error);

/* True for DPL_OK; else the error says what the context says. */
bool dpl_bench_good(dpl_status status, const dpl_context *context, dpl_error *error);

#endif
