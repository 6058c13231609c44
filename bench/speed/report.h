/* What a run found, as CSV and as Markdown. Used by main.c. */
#ifndef DPL_BENCH_REPORT_H
#define DPL_BENCH_REPORT_H

#include "../common/copy.h"
#include "../common/machine.h"
#include "trial.h"

#define DPL_BENCH_MAX_TRIALS 512

/* From the reference on, better and better. */
enum { DPL_BENCH_ISAS = 4 };
static const dpl_isa dpl_bench_isas[DPL_BENCH_ISAS] = {DPL_ISA_SCALAR, DPL_ISA_SSE2, DPL_ISA_AVX2,
                                                       DPL_ISA_AVX512};

typedef struct dpl_bench_findings {
    const dpl_bench_machine *machine;
    const dpl_context *context;
    char command[160];
    dpl_bench_trial trials[DPL_BENCH_MAX_TRIALS];
    int32_t count;
    double copy_rate; /* [GB/s] */
} dpl_bench_findings;

/* A row per trial. */
bool dpl_bench_write_csv(const char *path, const dpl_bench_findings *findings, dpl_error *error);

/* Tables of times, ratios, the one frame and bytes, and whether targets are met. */
bool dpl_bench_write_markdown(const char *path, const dpl_bench_findings *findings, dpl_error *error);

/* The table of the one frame alone. */
bool dpl_bench_write_frame(const char *path, const dpl_bench_findings *findings, dpl_error *error);

#endif
