/* One thing that is timed and counted again and again: rays through so many objects, or a flood of so many
 * cells. Made by worlds.c, run by measure.c, read by everything that reports. */
#ifndef DPL_COMPLEXITY_CASE_H
#define DPL_COMPLEXITY_CASE_H

#include "plan.h"

#include "bench/common/summary.h"

typedef enum dpl_complexity_method {
    DPL_COMPLEXITY_NAIVE,
    DPL_COMPLEXITY_BVH,
    DPL_COMPLEXITY_FLOOD
} dpl_complexity_method;

/* What a case is measured for. */
typedef enum dpl_complexity_part {
    DPL_COMPLEXITY_GROWTH,   /* how cost grows with size and rays */
    DPL_COMPLEXITY_CROSSOVER /* from how many objects on the hierarchy is faster */
} dpl_complexity_part;

/* What a run counts: object tests and node visits of rays, cells visited and queued of a flood. */
enum { DPL_COMPLEXITY_WORK, DPL_COMPLEXITY_STEPS, DPL_COMPLEXITY_COUNTS };

typedef struct dpl_complexity_case {
    dpl_complexity_method method;
    dpl_complexity_part part;
    int32_t size; /* objects, or the side of a world */
    int32_t rays; /* of a run; 0 for a flood */
    void *world;  /* a tracer or a flood, which worlds.c owns */
    bool counted; /* a run has filled `counts`; all later ones must repeat it */
    int64_t counts[DPL_COMPLEXITY_COUNTS];
    int32_t runs;                             /* in each sample, so that the clock's grain does not show */
    double cpu_ms[DPL_COMPLEXITY_ROUNDS_MAX]; /* processor time of one run, by round */
    dpl_bench_summary cpu;                    /* of those [ms] */
    dpl_bench_summary wall;                   /* the same by the clock on the wall [ms] */
} dpl_complexity_case;

/* Objects, or cells. */
double dpl_complexity_items(const dpl_complexity_case *c);

/* "naive", "bvh" or "flood". */
const char *dpl_complexity_method_name(dpl_complexity_method method);

#endif
