/* The results as CSV and Markdown. Used by main.c. */
#ifndef DPL_BENCH_REPORT_H
#define DPL_BENCH_REPORT_H

#include "../common/machine.h"
#include "solid.h"
#include "trial.h"

typedef struct dpl_bench_findings {
    const char *command;
    const dpl_bench_machine *machine;
    const dpl_context *context;
    const dpl_bench_trials *trials;
    const dpl_bench_agreement *agreement; /* with Embree; no rays without it */
    int64_t kept_bytes;                   /* of a picture's static hits */
    int32_t rounds;
} dpl_bench_findings;

bool dpl_bench_write_csv(const char *path, const dpl_bench_findings *findings, dpl_error *error);
bool dpl_bench_write_markdown(const char *path, const dpl_bench_findings *findings, dpl_error *error);

#endif
