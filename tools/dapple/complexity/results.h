/* All that the files of a run are written from. Used by tables.c, figure.c and page.c. */
#ifndef DPL_COMPLEXITY_RESULTS_H
#define DPL_COMPLEXITY_RESULTS_H

#include "findings.h"
#include "worlds.h"

#include "bench/common/machine.h"
#include "image/error.h"

typedef struct dpl_complexity_results {
    const dpl_complexity_worlds *worlds;
    dpl_complexity_findings findings;
    dpl_bench_machine machine;
} dpl_complexity_results;

#endif
