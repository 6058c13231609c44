/* FLIP's filters: made once per comparison, then run row by row. Called by flip.c.
 *
 * Source: Andersson et al., "FLIP: A Difference Evaluator for Alternating Images", 2020: table 1 and
 * equations 1 to 3 (contrast sensitivity), section 4.2 (features). */
#include "metric/flip_filter.h"

#include <math.h>

#define PI 3.14159265358979323846
/* Peak to trough of the eye's edge detector [degree]. */
#define FEATURE_WIDTH 0.082

/* A contrast sensitivity function is a sum of amplitude * sqrt(pi / decay) * exp(-pi^2 d^2 / decay), d in
 * degrees; blue-yellow is the only one with two terms. */
typedef struct contrast_term {
    int filter;
    int plane;
    double amplitude;
    double decay; /* [degree^2] */
} contrast_term;

static const contrast_term contrast_terms[] = {
    {DPL_FLIP_GAUSSIAN_A, DPL_FLIP_Y, 1.0, 0.0047},
    {DPL_FLIP_GAUSSIAN_RG, DPL_FLIP_CX, 1.0, 0.0053},
    {DPL_FLIP_GAUSSIAN_BY1, DPL_FLIP_CZ, 34.1, 0.04},
    {DPL_FLIP_GAUSSIAN_BY2, DPL_FLIP_CZ, 13.5, 0.025},
};

enum { CONTRAST_TERMS = sizeof contrast_terms / sizeof contrast_terms[0] };

/* The widest term: all share its radius, three standard deviations. */
#define DECAY_MAX 0.04

/* How each response comes about: one plane, filtered along columns, then along rows. */
typedef struct pass {
    int plane;
    int column_filter;
    int row_filter;
    int response;
} pass;

static const pass passes[] = {
    {DPL_FLIP_Y, DPL_FLIP_GAUSSIAN_A, DPL_FLIP_GAUSSIAN_A, DPL_FLIP_COLOR + DPL_FLIP_Y},
    {DPL_FLIP_CX, DPL_FLIP_GAUSSIAN_RG, DPL_FLIP_GAUSSIAN_RG, DPL_FLIP_COLOR + DPL_FLIP_CX},
    {DPL_FLIP_CZ, DPL_FLIP_GAUSSIAN_BY1, DPL_FLIP_GAUSSIAN_BY1, DPL_FLIP_COLOR + DPL_FLIP_CZ},
    {DPL_FLIP_CZ, DPL_FLIP_GAUSSIAN_BY2, DPL_FLIP_GAUSSIAN_BY2, DPL_FLIP_COLOR + DPL_FLIP_CZ},
    {DPL_FLIP_Y, DPL_FLIP_SMOOTH, DPL_FLIP_FIRST, DPL_FLIP_EDGE_X},
    {DPL_FLIP_Y, DPL_FLIP_FIRST, DPL_FLIP_SMOOTH, DPL_FLIP_EDGE_Y},
    {DPL_FLIP_Y, DPL_FLIP_SMOOTH, DPL_FLIP_SECOND, DPL_FLIP_POINT_X},
    {DPL_FLIP_Y, DPL_FLIP_SECOND, DPL_FLIP_SMOOTH, DPL_FLIP_POINT_Y},
};

enum { PASS_COUNT = sizeof passes / sizeof passes[0] };

/* ---- making --------------------------------------------------------------------------------------- */

static void scale_weights(const dpl_flip_filter *filter, double factor) {
    for (int32_t i = 0; i <= 2 * filter->radius; i++)
        filter->weights[i] *= factor;
}

/* exp(-decay * d^2), then scaled to sum to 1. Returns the sum before scaling. */
static double fill_gaussian(const dpl_flip_filter *filter, double decay) {
    double sum = 0.0;
    for (int32_t i = -filter->radius; i <= filter->radius; i++) {
        const double weight = exp(-decay * ((double)i * (double)i));
        filter->weights[i + filter->radius] = weight;
        sum += weight;
    }
    scale_weights(filter, 1.0 / sum);
    return sum;
}

/* Positive weights sum to 1 and negative ones to -1. A detector narrower than a pixel, which has only one
 * sign or none, sees nothing. */
static void balance_weights(const dpl_flip_filter *filter) {
    double positive = 0.0, negative = 0.0;
    for (int32_t i = 0; i <= 2 * filter->radius; i++) {
        const double weight = filter->weights[i];
        positive += weight > 0.0 ? weight : 0.0;
        negative -= weight < 0.0 ? weight : 0.0;
    }
    const bool seeing = positive > 0.0 && negative > 0.0;
    for (int32_t i = 0; i <= 2 * filter->radius; i++) {
        double *weight = &filter->weights[i];
        *weight = seeing ? *weight / (*weight < 0.0 ? negative : positive) : 0.0;
    }
}

static void fill_feature_filters(dpl_flip_filters *filters, double deviation) {
    const dpl_flip_filter *first = &filters->filter[DPL_FLIP_FIRST];
    const dpl_flip_filter *second = &filters->filter[DPL_FLIP_SECOND];
    const dpl_flip_filter *smooth = &filters->filter[DPL_FLIP_SMOOTH];
    const double variance = deviation * deviation;
    (void)fill_gaussian(smooth, 1.0 / (2.0 * variance));
    for (int32_t i = -smooth->radius; i <= smooth->radius; i++) {
        const double weight = smooth->weights[i + smooth->radius], distance = i;
        first->weights[i + smooth->radius] = -distance * weight;
        second->weights[i + smooth->radius] = (distance * distance / variance - 1.0) * weight;
    }
    balance_weights(first);
    balance_weights(second);
}

/* Each term becomes a filter of weight 1 and a share, so that the shares of a plane sum to 1. */
static void fill_contrast_filters(dpl_flip_filters *filters, double pixels_per_degree) {
    double total[DPL_FLIP_PLANES] = {0.0};
    for (int t = 0; t < CONTRAST_TERMS; t++) {
        const contrast_term *term = &contrast_terms[t];
        const double decay = PI * PI / (term->decay * pixels_per_degree * pixels_per_degree);
        const double sum = fill_gaussian(&filters->filter[term->filter], decay);
        filters->share[term->filter] = term->amplitude * sqrt(PI / term->decay) * (sum * sum);
        total[term->plane] += filters->share[term->filter];
    }
    for (int t = 0; t < CONTRAST_TERMS; t++)
        filters->share[contrast_terms[t].filter] /= total[contrast_terms[t].plane];
}

dpl_status dpl_flip_filters_create(dpl_context *context, double pixels_per_degree,
                                   dpl_flip_filters *filters) {
    *filters = (dpl_flip_filters){0};
    const double deviation = 0.5 * FEATURE_WIDTH * pixels_per_degree;
    const int32_t contrast_radius =
        (int32_t)ceil(3.0 * sqrt(DECAY_MAX / (2.0 * PI * PI)) * pixels_per_degree);
    const int32_t feature_radius = (int32_t)ceil(3.0 * deviation);
    filters->radius_max = contrast_radius > feature_radius ? contrast_radius : feature_radius;
    const size_t weights = 2 * (size_t)filters->radius_max + 1;
    DPL_TRY(dpl_buffer_reserve(context, &filters->memory, DPL_FLIP_FILTERS * weights, sizeof(double)));
    for (int f = 0; f < DPL_FLIP_FILTERS; f++) {
        filters->filter[f].radius = f < DPL_FLIP_SMOOTH ? contrast_radius : feature_radius;
        filters->filter[f].weights = (double *)filters->memory.data + (size_t)f * weights;
        filters->share[f] = 1.0;
    }
    fill_contrast_filters(filters, pixels_per_degree);
    fill_feature_filters(filters, deviation);
    return DPL_OK;
}

void dpl_flip_filters_free(dpl_context *context, dpl_flip_filters *filters) {
    dpl_buffer_free(context, &filters->memory);
}

/* ---- running -------------------------------------------------------------------------------------- */

static int32_t clamp_to(int32_t v, int32_t size) {
    return v < 0 ? 0 : v < size ? v : size - 1;
}

static void add_scaled_float(int32_t count, double *restrict sum, const float *restrict values,
                             double weight) {
    for (int32_t i = 0; i < count; i++)
        sum[i] += weight * (double)values[i];
}

static void add_scaled(int32_t count, double *restrict sum, const double *restrict values, double weight) {
    for (int32_t i = 0; i < count; i++)
        sum[i] += weight * values[i];
}

static void filter_columns(const dpl_flip_filter *filter, const dpl_flip_planes *planes, int plane, int32_t y,
                           double *restrict out) {
    const size_t width = (size_t)planes->width, height = (size_t)planes->height;
    memset(out, 0, width * sizeof *out);
    for (int32_t i = -filter->radius; i <= filter->radius; i++) {
        const size_t row = (size_t)clamp_to(y + i, planes->height);
        add_scaled_float(planes->width, out, planes->data + ((size_t)plane * height + row) * width,
                         filter->weights[i + filter->radius]);
    }
}

static void repeat_ends(double *padded, int32_t width, int32_t radius) {
    for (int32_t i = 0; i < radius; i++) {
        padded[i] = padded[radius];
        padded[radius + width + i] = padded[radius + width - 1];
    }
}

void dpl_flip_filter_row(const dpl_flip_filters *filters, const dpl_flip_planes *planes, int32_t y,
                         double *restrict padded, double *restrict responses) {
    memset(responses, 0, DPL_FLIP_RESPONSES * (size_t)planes->width * sizeof *responses);
    for (int p = 0; p < PASS_COUNT; p++) {
        const pass *now = &passes[p];
        const dpl_flip_filter *row_filter = &filters->filter[now->row_filter];
        filter_columns(&filters->filter[now->column_filter], planes, now->plane, y,
                       padded + row_filter->radius);
        repeat_ends(padded, planes->width, row_filter->radius);
        double *response = responses + (size_t)now->response * (size_t)planes->width;
        for (int32_t i = 0; i <= 2 * row_filter->radius; i++)
            add_scaled(planes->width, response, padded + i,
                       filters->share[now->row_filter] * row_filter->weights[i]);
    }
}
