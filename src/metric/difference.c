/* The metrics that are sums of squared differences: PSNR (linear and display) and relative RMSE. Called by
 * compare.c. */
#include "metric/measures.h"

#include "kernel/srgb.h"
#include "metric/display.h"
#include "metric/rows.h"
#include "metric/view.h"

#include <math.h>

/* What the two sums of a row are. */
enum { SQUARED_ERROR, REFERENCE };

#define PEAK_LINEAR 1.0
#define PEAK_DISPLAY 255.0

static double psnr(double mean_squared_error, double peak) {
    return mean_squared_error > 0.0 ? 10.0 * log10(peak * peak / mean_squared_error) : (double)INFINITY;
}

static double relative_rmse(double mean_squared_error, double reference_mean) {
    if (mean_squared_error == 0.0)
        return 0.0;
    return reference_mean > 0.0 ? sqrt(mean_squared_error) / reference_mean : (double)INFINITY;
}

static double linear_value(const dpl_pair *pair, float v) {
    return pair->display_referred ? dpl_srgb_decode((double)v) : (double)v;
}

static void add_linear_row(int32_t y, int32_t worker, const void *task, double sums[DPL_ROW_SUMS]) {
    (void)worker;
    const dpl_pair *pair = task;
    const dpl_pixels *views = pair->pixels;
    const float *test = dpl_view_row(&views[DPL_PAIR_TEST], y);
    const float *reference = dpl_view_row(&views[DPL_PAIR_REFERENCE], y);
    for (int32_t x = 0; x < pair->width; x++) {
        if (!dpl_pair_is_free(pair, x, y))
            continue;
        for (int32_t c = 0; c < 3; c++) {
            const double truth = linear_value(pair, reference[x * views[DPL_PAIR_REFERENCE].channels + c]);
            const double error = linear_value(pair, test[x * views[DPL_PAIR_TEST].channels + c]) - truth;
            sums[SQUARED_ERROR] += error * error;
            sums[REFERENCE] += truth;
        }
    }
}

dpl_status dpl_measure_linear(dpl_context *context, const dpl_pair *pair, dpl_metrics *metrics) {
    double sums[DPL_ROW_SUMS];
    DPL_TRY(dpl_rows_sum(context, pair->height, add_linear_row, pair, sums));
    const double values = 3.0 * (double)pair->free_pixels;
    const double mean_squared_error = sums[SQUARED_ERROR] / values;
    metrics->psnr_linear = psnr(mean_squared_error, PEAK_LINEAR);
    metrics->rel_rmse = relative_rmse(mean_squared_error, sums[REFERENCE] / values);
    return DPL_OK;
}

/* Masked pixels are equal in both displays: they add nothing. */
static void add_display_row(int32_t y, int32_t worker, const void *task, double sums[DPL_ROW_SUMS]) {
    (void)worker;
    const dpl_pair *pair = task;
    const uint8_t *test = dpl_pair_display_row(pair, DPL_PAIR_TEST, y);
    const uint8_t *reference = dpl_pair_display_row(pair, DPL_PAIR_REFERENCE, y);
    int64_t sum = 0;
    for (int32_t i = 0; i < 3 * pair->width; i++) {
        const int32_t error = test[i] - reference[i];
        sum += error * error;
    }
    sums[SQUARED_ERROR] = (double)sum;
}

dpl_status dpl_measure_display(dpl_context *context, const dpl_pair *pair, dpl_metrics *metrics) {
    double sums[DPL_ROW_SUMS];
    DPL_TRY(dpl_rows_sum(context, pair->height, add_display_row, pair, sums));
    metrics->psnr_display = psnr(sums[SQUARED_ERROR] / (3.0 * (double)pair->free_pixels), PEAK_DISPLAY);
    return DPL_OK;
}
