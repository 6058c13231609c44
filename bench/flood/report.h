/* Writes what was measured. Called by main.c. */
#ifndef DPL_BENCH_FLOOD_REPORT_H
#define DPL_BENCH_FLOOD_REPORT_H

#include "../common/machine.h"
#include "measure.h"

bool dpl_bench_flood_write_csv(const char *path, const dpl_bench_flood_table *table, dpl_error *error);

bool dpl_bench_flood_write_markdown(const char *path, const dpl_bench_flood_plan *plan,
                                    const dpl_bench_machine *machine, const dpl_bench_flood_table *table,
                                    dpl_error *error);

#endif
