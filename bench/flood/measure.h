/* What tile light costs: solves by size, torches, edits, and depth first. Used by main.c and report.c. */
#ifndef DPL_BENCH_FLOOD_MEASURE_H
#define DPL_BENCH_FLOOD_MEASURE_H

#include "../../image/error.h"
#include "../common/summary.h"

#include <dapple/dapple.h>

/* One line of the results. */
typedef struct dpl_bench_flood_row {
    const char *what; /* "solve", "place", "remove", "edit", "depth first" */
    dpl_flood_falloff falloff;
    int32_t size[3];         /* [cell] */
    int32_t blocks;          /* share of opaque cells [%] */
    const char *unit;        /* of `value` */
    dpl_bench_summary value; /* processor time; "depth first": visits over those breadth first */
    int64_t visits;          /* of the last one */
    int64_t pushes;
} dpl_bench_flood_row;

#define DPL_BENCH_FLOOD_ROWS 64

typedef struct dpl_bench_flood_table {
    dpl_bench_flood_row rows[DPL_BENCH_FLOOD_ROWS];
    int32_t count;
} dpl_bench_flood_table;

typedef struct dpl_bench_flood_plan {
    dpl_context *context;
    int32_t largest; /* side of the largest 2D world, from 64 on doubling */
    int32_t side;    /* of the 3D world */
    int32_t frames;  /* samples per row */
} dpl_bench_flood_plan;

bool dpl_bench_flood_measure(const dpl_bench_flood_plan *plan, dpl_bench_flood_table *table,
                             dpl_error *error);

#endif
