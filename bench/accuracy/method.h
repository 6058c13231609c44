/* The methods that are judged, as data. Used by the rest of this folder. */
#ifndef DPL_BENCH_METHOD_H
#define DPL_BENCH_METHOD_H

#include <dapple/solver.h>
#include <stdbool.h>

/* Most methods of one run: every merge with every interval of the sweep. */
#define DPL_BENCH_MAX_METHODS 32

/* What the project promises over the 50 ARC scenes; 0: no promise. */
typedef struct dpl_bench_target {
    double mean;    /* greatest mean of rel_rmse */
    double worst;   /* greatest rel_rmse of one scene */
    double display; /* least mean of psnr_display [dB] */
} dpl_bench_target;

typedef struct dpl_bench_method {
    char name[40]; /* as tables spell it, without commas */
    dpl_solver_kind kind;
    dpl_cascades_desc cascades; /* of one kind, zeros are the library's defaults */
    dpl_holographic_desc holographic;
    dpl_bench_target target;
} dpl_bench_method;

/* The methods of a judgement, `all` with the slow ones. Returns how many. */
int32_t dpl_bench_methods_standard(bool all, dpl_bench_method methods[DPL_BENCH_MAX_METHODS]);

/* Those that are judged on many families, `all` with the slow one. Returns how many. */
int32_t dpl_bench_methods_families(bool all, dpl_bench_method methods[DPL_BENCH_MAX_METHODS]);

/* Each merge with each length of the first interval, for choosing defaults. Returns how many: merges one
 * after the other, intervals rising. */
int32_t dpl_bench_methods_sweep(dpl_bench_method methods[DPL_BENCH_MAX_METHODS]);

/* Keeps those of `count` methods that know bounces. Returns how many. */
int32_t dpl_bench_methods_that_bounce(dpl_bench_method methods[DPL_BENCH_MAX_METHODS], int32_t count);

#endif
