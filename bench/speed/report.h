/* What a run found, as CSV and as Markdown. Used by main.c. */
#ifndef DPL_BENCH_REPORT_H
#define DPL_BENCH_REPORT_H

#include "../common/copy.h"
#include "../common/machine.h"
#include "trial.h"

#define DPL_BENCH_MAX_TRIALS 512

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

/* Tables of times, ratios, instruction sets and bytes, and whether targets are met. */
bool dpl_bench_write_markdown(const char *path, const dpl_bench_findings *findings, dpl_error *error);

#endif
