/* Mean structural similarity of the luminance that a display shows. Called by compare.c.
 *
 * Source: Wang, Bovik, Sheikh, Simoncelli, "Image quality assessment: from error visibility to structural
 * similarity", 2004. The window is an 11 x 11 Gaussian; at the border it is what lies inside the picture,
 * with weights that sum to 1 again. Both factor into columns and rows. */
#include "metric/measures.h"

#include "job/jobs.h"
#include "metric/rows.h"

#include <math.h>

#define RADIUS 5
#define SIGMA 1.5
#define PEAK 255.0
#define C1 ((0.01 * PEAK) * (0.01 * PEAK))
#define C2 ((0.03 * PEAK) * (0.03 * PEAK))

/* The window's means that the index is made of: of a, b, a^2, b^2 and ab (a the test, b the reference). */
enum { MEAN_A, MEAN_B, MEAN_AA, MEAN_BB, MEAN_AB, MEAN_COUNT };

typedef struct ssim {
    const dpl_pair *pair;
    double window[2 * RADIUS + 1];
    dpl_buffer luminance; /* doubles, shape [DPL_PAIR_COUNT][height][width] */
    dpl_buffer columns;   /* doubles, shape [worker][MEAN_COUNT][width]: means over a column of the window */
} ssim;

static double *luminance_row(const ssim *s, int picture, int32_t y) {
    const size_t width = (size_t)s->pair->width, height = (size_t)s->pair->height;
    return (double *)s->luminance.data + ((size_t)picture * height + (size_t)y) * width;
}

static void fill_luminance(int32_t begin, int32_t end, int32_t worker, void *task) {
    (void)worker;
    const ssim *s = task;
    for (int32_t y = begin; y < end; y++)
        for (int picture = 0; picture < DPL_PAIR_COUNT; picture++) {
            const uint8_t *rgb = dpl_pair_display_row(s->pair, picture, y);
            double *row = luminance_row(s, picture, y);
            for (int32_t x = 0; x < s->pair->width; x++)
                row[x] = 0.2126 * rgb[3 * x] + 0.7152 * rgb[3 * x + 1] + 0.0722 * rgb[3 * x + 2];
        }
}

static void fill_window(double window[2 * RADIUS + 1]) {
    for (int i = -RADIUS; i <= RADIUS; i++)
        window[i + RADIUS] = exp(-(double)(i * i) / (2.0 * SIGMA * SIGMA));
}

/* The part of the window around `center` that lies inside [0, size): first and last offset, and 1 / weight.
 */
typedef struct span {
    int32_t first, last;
    double scale;
} span;

static span span_inside(const ssim *s, int32_t center, int32_t size) {
    span inside = {.first = center < RADIUS ? -center : -RADIUS,
                   .last = size - 1 - center < RADIUS ? size - 1 - center : RADIUS};
    double weight = 0.0;
    for (int32_t i = inside.first; i <= inside.last; i++)
        weight += s->window[i + RADIUS];
    inside.scale = 1.0 / weight;
    return inside;
}

static void add_weighted_row(int32_t width, double weight, const double *restrict a, const double *restrict b,
                             double *restrict means) {
    double *restrict mean_a = means, *restrict mean_b = mean_a + width, *restrict mean_aa = mean_b + width;
    double *restrict mean_bb = mean_aa + width, *restrict mean_ab = mean_bb + width;
    for (int32_t x = 0; x < width; x++) {
        mean_a[x] += weight * a[x];
        mean_b[x] += weight * b[x];
        mean_aa[x] += weight * (a[x] * a[x]);
        mean_bb[x] += weight * (b[x] * b[x]);
        mean_ab[x] += weight * (a[x] * b[x]);
    }
}

static void fill_columns(const ssim *s, int32_t y, double *means) {
    const int32_t width = s->pair->width;
    memset(means, 0, MEAN_COUNT * (size_t)width * sizeof *means);
    const span rows = span_inside(s, y, s->pair->height);
    for (int32_t i = rows.first; i <= rows.last; i++)
        add_weighted_row(width, s->window[i + RADIUS] * rows.scale, luminance_row(s, DPL_PAIR_TEST, y + i),
                         luminance_row(s, DPL_PAIR_REFERENCE, y + i), means);
}

static double similarity(const double mean[MEAN_COUNT]) {
    const double a = mean[MEAN_A], b = mean[MEAN_B];
    const double variance_a = mean[MEAN_AA] - a * a, variance_b = mean[MEAN_BB] - b * b;
    const double covariance = mean[MEAN_AB] - a * b;
    return (2.0 * (a * b) + C1) * (2.0 * covariance + C2) /
           ((a * a + b * b + C1) * (variance_a + variance_b + C2));
}

static void add_row(int32_t y, int32_t worker, const void *task, double sums[DPL_ROW_SUMS]) {
    const ssim *s = task;
    const int32_t width = s->pair->width;
    double *columns = (double *)s->columns.data + (size_t)worker * MEAN_COUNT * (size_t)width;
    fill_columns(s, y, columns);
    for (int32_t x = 0; x < width; x++) {
        if (!dpl_pair_is_free(s->pair, x, y))
            continue;
        const span inside = span_inside(s, x, width);
        double mean[MEAN_COUNT] = {0.0};
        for (int32_t i = inside.first; i <= inside.last; i++)
            for (int m = 0; m < MEAN_COUNT; m++)
                mean[m] += s->window[i + RADIUS] * inside.scale * columns[m * width + x + i];
        sums[0] += similarity(mean);
    }
}

static dpl_status prepare(dpl_context *context, ssim *s) {
    const size_t width = (size_t)s->pair->width, height = (size_t)s->pair->height;
    const size_t workers = (size_t)dpl_jobs_worker_count(context->jobs);
    fill_window(s->window);
    DPL_TRY(dpl_buffer_reserve(context, &s->luminance, DPL_PAIR_COUNT * width * height, sizeof(double)));
    DPL_TRY(dpl_buffer_reserve(context, &s->columns, workers * MEAN_COUNT * width, sizeof(double)));
    return dpl_jobs_run(context, fill_luminance, s->pair->height, 1, s);
}

dpl_status dpl_measure_ssim(dpl_context *context, const dpl_pair *pair, dpl_metrics *metrics) {
    ssim s = {.pair = pair};
    double sums[DPL_ROW_SUMS];
    dpl_status status = prepare(context, &s);
    if (status == DPL_OK)
        status = dpl_rows_sum(context, pair->height, add_row, &s, sums);
    if (status == DPL_OK)
        metrics->ssim = sums[0] / (double)pair->free_pixels;
    dpl_buffer_free(context, &s.columns);
    dpl_buffer_free(context, &s.luminance);
    return status;
}
