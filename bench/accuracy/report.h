/* What a run found, as CSV (every scene and method) and as Markdown (a table of summaries). Used by main.c.
 */
#ifndef DPL_BENCH_REPORT_H
#define DPL_BENCH_REPORT_H

#include "../common/machine.h"
#include "judge.h"

/* A finished run, over one family or a chain of them with the same methods. The first has no fewer scenes
 * than those behind it. */
typedef struct dpl_bench_findings {
    const dpl_bench_trial *trial;
    const dpl_bench_machine *machine;
    const dpl_context *context; /* that the run used */
    const dpl_bench_method *methods;
    int32_t method_count;
    const dpl_bench_score *scores;         /* shape [trial->count][method_count] */
    const char *options;                   /* of the command line beyond the trial, " --all" or such, or "" */
    const struct dpl_bench_findings *next; /* of the next family, or NULL */
} dpl_bench_findings;

/* A row per scene and method. */
bool dpl_bench_write_csv(const char *path, const dpl_bench_findings *findings, dpl_error *error);

/* The judgement: a table of methods, and whether targets are met. */
bool dpl_bench_write_accuracy(const char *path, const dpl_bench_findings *findings, dpl_error *error);

/* Several families: a table with a row for each. */
bool dpl_bench_write_families(const char *path, const dpl_bench_findings *findings, dpl_error *error);

/* The sweep: a table of intervals for each merge. */
bool dpl_bench_write_tuning(const char *path, const dpl_bench_findings *findings, dpl_error *error);

#endif
