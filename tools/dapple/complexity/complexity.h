/* The work of `dapple complexity`, once its arguments are known to be good. Called by cmd_complexity.c. */
#ifndef DPL_COMPLEXITY_COMPLEXITY_H
#define DPL_COMPLEXITY_COMPLEXITY_H

#include "plan.h"

/* Measures, writes everything at the end, reports what failed. Returns an exit status. */
int dpl_complexity_run(const dpl_complexity_plan *plan);

#endif
