/* What a run found, as CSV, as Markdown and as a plot. Used by main.c. */
#ifndef DPL_BENCH_REPORT_H
#define DPL_BENCH_REPORT_H

#include "../common/machine.h"
#include "measure.h"

/* A finished run. Measurements come merge by merge, then by thread count, then by size, each rising. */
typedef struct dpl_bench_findings {
    const dpl_bench_subject *subject;
    const dpl_bench_machine *machine;
    const dpl_context *context; /* one with the same kernels */
    const dpl_bench_measurement *measurements;
    int32_t count;
    int32_t smallest; /* [px] */
    int32_t largest;
    int32_t max_threads;
} dpl_bench_findings;

/* A row per measurement. */
bool dpl_bench_write_csv(const char *path, const dpl_bench_findings *findings, dpl_error *error);

/* Tables, and what the growth is. */
bool dpl_bench_write_markdown(const char *path, const dpl_bench_findings *findings, dpl_error *error);

/* Draws scaling.png from the scaling.csv of the working folder. False when gnuplot is missing or fails. */
bool dpl_bench_plot(dpl_error *error);

#endif
