/* Sums over a picture that come out the same for every number of threads: one pair of sums per row, made in
 * parallel, then added from top to bottom. Used by every metric. */
#ifndef DPL_METRIC_ROWS_H
#define DPL_METRIC_ROWS_H

#include "base/context.h"

enum { DPL_ROW_SUMS = 2 };

/* Handles one row. `sums` is zero on entry; no two calls at a time share a worker. */
typedef void (*dpl_row_function)(int32_t y, int32_t worker, const void *task, double sums[DPL_ROW_SUMS]);

DPL_MUST_CHECK dpl_status dpl_rows_sum(dpl_context *context, int32_t height, dpl_row_function function,
                                       const void *task, double sums[DPL_ROW_SUMS]);

#endif
