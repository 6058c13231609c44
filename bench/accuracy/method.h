/* The methods that are judged, as data. Used by the rest of this folder. */
#ifndef DPL_BENCH_METHOD_H
#define DPL_BENCH_METHOD_H

#include <dapple/schedule.h>
#include <stdbool.h>

/* Most methods of one run: every merge with every interval of the sweep. */
#define DPL_BENCH_MAX_METHODS 32

typedef struct dpl_bench_method {
    char name[40];              /* as tables spell it, without commas */
    dpl_cascades_desc cascades; /* zeros are the library's defaults */
    double target; /* mean rel_rmse over the 50 ARC scenes that the project promises; 0: no promise */
} dpl_bench_method;

/* The methods of a judgement, `all` with the slow ones. Returns how many. */
int32_t dpl_bench_methods_standard(bool all, dpl_bench_method methods[DPL_BENCH_MAX_METHODS]);

/* Each merge with each length of the first interval, for choosing defaults. Returns how many: merges one
 * after the other, intervals rising. */
int32_t dpl_bench_methods_sweep(dpl_bench_method methods[DPL_BENCH_MAX_METHODS]);

#endif
