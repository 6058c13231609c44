/* Solves one scene without skipping, exactly and within a bound, in turns. Used by main.c. */
#ifndef DPL_BENCH_MEASURE_H
#define DPL_BENCH_MEASURE_H

#include "../../image/error.h"

#include <dapple/dapple.h>

enum { DPL_BENCH_OFF, DPL_BENCH_EXACT, DPL_BENCH_BOUNDED, DPL_BENCH_MODES };

/* How all scenes are solved. */
typedef struct dpl_bench_plan {
    int32_t size;   /* [px] */
    int32_t frames; /* that are timed, of each mode */
    dpl_cascades_desc cascades;
} dpl_bench_plan;

/* What one scene came to. */
typedef struct dpl_bench_row {
    const char *subject;
    uint64_t seed;
    int32_t index;
    double saved[DPL_BENCH_MODES];        /* share of rays, counted */
    double cpu_ms[DPL_BENCH_MODES];       /* least processor time of a frame, distances measured before */
    double psnr_display[DPL_BENCH_MODES]; /* against off [dB]; a picture that is equal counts as 120 */
    double rel_rmse[DPL_BENCH_MODES];
    bool equal[DPL_BENCH_MODES]; /* every bit */
    double guessed;              /* bounded: share of rays */
    int64_t checked;
    int64_t wrong;
} dpl_bench_row;

bool dpl_bench_measure(const dpl_bench_plan *plan, dpl_context *context, dpl_field *field, dpl_bench_row *row,
                       dpl_error *error);

#endif
