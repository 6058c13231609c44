/* The tables of a run: tracing.csv, flood.csv, findings.csv and paper.csv. Called by complexity.c. */
#ifndef DPL_COMPLEXITY_TABLES_H
#define DPL_COMPLEXITY_TABLES_H

#include "results.h"

bool dpl_complexity_write_tables(const dpl_complexity_results *results, dpl_error *error);

#endif
