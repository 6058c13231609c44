/* Wall times and the machine: times.csv and times.md, which alone (with the journal) differ from run to run.
 * Called by study.c. */
#ifndef DPL_STUDY_TIMES_H
#define DPL_STUDY_TIMES_H

#include "results.h"

#include <dapple/context.h>

#include "image/error.h"

/* `isa` is the instruction set that this run used. */
bool dpl_study_write_times(const dpl_study_results *results, dpl_isa isa, dpl_error *error);

#endif
