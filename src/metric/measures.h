/* The single metrics: each reads a pair and gives its numbers. Called by compare.c. */
#ifndef DPL_METRIC_MEASURES_H
#define DPL_METRIC_MEASURES_H

#include "metric/pair.h"

/* psnr_linear and rel_rmse. */
DPL_MUST_CHECK dpl_status dpl_measure_linear(dpl_context *context, const dpl_pair *pair,
                                             dpl_metrics *metrics);

/* psnr_display. */
DPL_MUST_CHECK dpl_status dpl_measure_display(dpl_context *context, const dpl_pair *pair,
                                              dpl_metrics *metrics);

/* ssim. */
DPL_MUST_CHECK dpl_status dpl_measure_ssim(dpl_context *context, const dpl_pair *pair, dpl_metrics *metrics);

/* flip. */
DPL_MUST_CHECK dpl_status dpl_measure_flip(dpl_context *context, const dpl_pair *pair, dpl_metrics *metrics);

#endif
