/* dpl_metrics_compare(): loads the pair and asks every metric. Called by the user. */
#include <dapple/metric.h>

#include "base/desc.h"
#include "metric/measures.h"

typedef dpl_status (*measure)(dpl_context *context, const dpl_pair *pair, dpl_metrics *metrics);

static const measure measures[] = {
    dpl_measure_linear,
    dpl_measure_display,
    dpl_measure_ssim,
    dpl_measure_flip,
};

enum { MEASURE_COUNT = sizeof measures / sizeof measures[0] };

static dpl_status measure_all(dpl_context *context, const dpl_pair *pair, dpl_metrics *metrics) {
    for (int i = 0; i < MEASURE_COUNT; i++)
        DPL_TRY(measures[i](context, pair, metrics));
    metrics->pixels = pair->free_pixels;
    return DPL_OK;
}

dpl_status dpl_metrics_compare(dpl_context *context, const dpl_metrics_desc *desc, dpl_metrics *metrics) {
    if (!context)
        return DPL_ERROR_ARGUMENT;
    if (!desc || !metrics)
        return dpl_fail(context, DPL_ERROR_ARGUMENT, "desc or metrics is NULL");
    if (!DPL_DESC_IS_GOOD(desc))
        return dpl_fail(context, DPL_ERROR_DESC, "the desc was not made by dpl_metrics_desc_default()");
    dpl_pair pair;
    DPL_TRY(dpl_pair_open(context, desc, &pair));
    dpl_metrics measured = {0};
    const dpl_status status = measure_all(context, &pair, &measured);
    dpl_pair_close(context, &pair);
    if (status == DPL_OK)
        *metrics = measured;
    return status;
}
