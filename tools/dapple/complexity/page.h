/* The page of a run, complexity.html: findings, figure, tables, and what the paper plotted. Called by
 * complexity.c. */
#ifndef DPL_COMPLEXITY_PAGE_H
#define DPL_COMPLEXITY_PAGE_H

#include "results.h"

/* `figure`: there is one. */
bool dpl_complexity_write_page(const dpl_complexity_results *results, bool figure, dpl_error *error);

#endif
