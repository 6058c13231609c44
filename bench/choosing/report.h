/* choosing.csv and choosing.md: what a newcomer needs in order to choose. Called by main.c. */
#ifndef DPL_BENCH_CHOOSING_REPORT_H
#define DPL_BENCH_CHOOSING_REPORT_H

#include "../common/machine.h"
#include "judge.h"

typedef struct dpl_bench_choosing_results {
    const dpl_bench_choosing_plan *plan;
    const dpl_bench_machine *machine;
    const dpl_context *context; /* for the machine's instruction set */
    const dpl_bench_choosing_scene *scenes;
    int32_t scene_count;
    const dpl_bench_choosing_score (*scores)[DPL_BENCH_CHOOSING_METHODS];
} dpl_bench_choosing_results;

bool dpl_bench_choosing_write_csv(const char *path, const dpl_bench_choosing_results *results,
                                  dpl_error *error);
bool dpl_bench_choosing_write_markdown(const char *path, const dpl_bench_choosing_results *results,
                                       dpl_error *error);

#endif
