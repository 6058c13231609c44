/* Mean LDR-FLIP of what a display shows: how large the difference looks when flipping between both pictures.
 * Called by compare.c.
 *
 * Source: Andersson, Nilsson, Akenine-Moller, Oskarsson, Astrom, Fairchild, "FLIP: A Difference Evaluator for
 * Alternating Images", 2020. */
#include "metric/measures.h"

#include "job/jobs.h"
#include "metric/flip_color.h"
#include "metric/flip_filter.h"
#include "metric/rows.h"

#include <math.h>

typedef struct flip {
    const dpl_pair *pair;
    double linear[256];    /* light of each 8-bit value */
    double difference_max; /* of colours */
    dpl_flip_filters filters;
    dpl_buffer planes;    /* floats, shape [DPL_PAIR_COUNT][DPL_FLIP_PLANES][height][width] */
    dpl_buffer scratch;   /* doubles, per worker: a padded row, then the responses of both pictures */
    size_t scratch_count; /* per worker */
} flip;

static float *picture_planes(const flip *f, int picture) {
    const size_t pixels = (size_t)f->pair->width * (size_t)f->pair->height;
    return (float *)f->planes.data + (size_t)picture * DPL_FLIP_PLANES * pixels;
}

static void fill_plane_row(const flip *f, int picture, int32_t y) {
    const size_t width = (size_t)f->pair->width, pixels = width * (size_t)f->pair->height;
    const uint8_t *rgb = dpl_pair_display_row(f->pair, picture, y);
    float *row = picture_planes(f, picture) + (size_t)y * width;
    for (size_t x = 0; x < width; x++) {
        double opponent[DPL_FLIP_PLANES];
        dpl_flip_opponent(f->linear, rgb + 3 * x, opponent);
        for (size_t plane = 0; plane < DPL_FLIP_PLANES; plane++)
            row[plane * pixels + x] = (float)opponent[plane];
    }
}

static void fill_planes(int32_t begin, int32_t end, int32_t worker, void *task) {
    (void)worker;
    for (int32_t y = begin; y < end; y++)
        for (int picture = 0; picture < DPL_PAIR_COUNT; picture++)
            fill_plane_row(task, picture, y);
}

/* What a picture looks like at a pixel. */
typedef struct appearance {
    double lab[3];
    dpl_flip_features features;
} appearance;

static double length(double x, double y) {
    return sqrt(x * x + y * y);
}

static appearance appearance_at(const double *responses, size_t width, size_t x) {
    double at[DPL_FLIP_RESPONSES];
    for (size_t r = 0; r < DPL_FLIP_RESPONSES; r++)
        at[r] = responses[r * width + x];
    appearance seen;
    dpl_flip_perceptual(at + DPL_FLIP_COLOR, seen.lab);
    /* Features are those of relative luminance, (Y + 16) / 116; derivatives lose the offset. */
    seen.features.edge = length(at[DPL_FLIP_EDGE_X], at[DPL_FLIP_EDGE_Y]) / 116.0;
    seen.features.point = length(at[DPL_FLIP_POINT_X], at[DPL_FLIP_POINT_Y]) / 116.0;
    return seen;
}

static double error_between(const flip *f, const appearance *test, const appearance *reference) {
    return dpl_flip_error(dpl_flip_color_error(test->lab, reference->lab, f->difference_max),
                          dpl_flip_feature_error(test->features, reference->features));
}

static void add_row(int32_t y, int32_t worker, const void *task, double sums[DPL_ROW_SUMS]) {
    const flip *f = task;
    const size_t width = (size_t)f->pair->width;
    double *padded = (double *)f->scratch.data + (size_t)worker * f->scratch_count;
    double *responses[DPL_PAIR_COUNT];
    for (int picture = 0; picture < DPL_PAIR_COUNT; picture++) {
        const dpl_flip_planes planes = {picture_planes(f, picture), f->pair->width, f->pair->height};
        responses[picture] =
            padded + width + 2 * (size_t)f->filters.radius_max + (size_t)picture * DPL_FLIP_RESPONSES * width;
        dpl_flip_filter_row(&f->filters, &planes, y, padded, responses[picture]);
    }
    for (int32_t x = 0; x < f->pair->width; x++) {
        if (!dpl_pair_is_free(f->pair, x, y))
            continue;
        const appearance test = appearance_at(responses[DPL_PAIR_TEST], width, (size_t)x);
        const appearance reference = appearance_at(responses[DPL_PAIR_REFERENCE], width, (size_t)x);
        sums[0] += error_between(f, &test, &reference);
    }
}

static dpl_status prepare(dpl_context *context, flip *f) {
    const size_t width = (size_t)f->pair->width, height = (size_t)f->pair->height;
    const size_t workers = (size_t)dpl_jobs_worker_count(context->jobs);
    dpl_flip_fill_linear(f->linear);
    f->difference_max = dpl_flip_difference_max();
    DPL_TRY(dpl_flip_filters_create(context, f->pair->pixels_per_degree, &f->filters));
    f->scratch_count =
        width + 2 * (size_t)f->filters.radius_max + (size_t)DPL_PAIR_COUNT * DPL_FLIP_RESPONSES * width;
    DPL_TRY(dpl_buffer_reserve(context, &f->planes, (size_t)DPL_PAIR_COUNT * DPL_FLIP_PLANES * width * height,
                               sizeof(float)));
    DPL_TRY(dpl_buffer_reserve(context, &f->scratch, workers * f->scratch_count, sizeof(double)));
    return dpl_jobs_run(context, fill_planes, f->pair->height, 1, f);
}

dpl_status dpl_measure_flip(dpl_context *context, const dpl_pair *pair, dpl_metrics *metrics) {
    flip f = {.pair = pair};
    double sums[DPL_ROW_SUMS];
    dpl_status status = prepare(context, &f);
    if (status == DPL_OK)
        status = dpl_rows_sum(context, pair->height, add_row, &f, sums);
    if (status == DPL_OK)
        metrics->flip = sums[0] / (double)pair->free_pixels;
    dpl_buffer_free(context, &f.scratch);
    dpl_buffer_free(context, &f.planes);
    dpl_flip_filters_free(context, &f.filters);
    return status;
}
