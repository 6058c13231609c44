/* The work of `dapple study`, once its arguments are known to be good. Called by cmd_study.c. */
#ifndef DPL_STUDY_STUDY_H
#define DPL_STUDY_STUDY_H

#include "plan.h"

/* Runs or goes on with a study, writes its files, reports what failed. Returns an exit status: also 128 + the
 * signal that stopped it. */
int dpl_study_run(const dpl_study_plan *plan);

#endif
