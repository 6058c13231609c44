/* What the scenes came to, as CSV and Markdown. Used by main.c. */
#ifndef DPL_BENCH_REPORT_H
#define DPL_BENCH_REPORT_H

#include "../common/machine.h"
#include "measure.h"

typedef struct dpl_bench_findings {
    const dpl_bench_plan *plan;
    const dpl_bench_machine *machine;
    const dpl_context *context;
    const char *command; /* its arguments */
    const dpl_bench_row *rows;
    int32_t count;
} dpl_bench_findings;

bool dpl_bench_write_rows(const char *path, const dpl_bench_findings *f, dpl_error *error);
bool dpl_bench_write_table(const char *path, const dpl_bench_findings *f, dpl_error *error);

#endif
