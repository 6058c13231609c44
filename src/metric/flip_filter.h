/* The filters of FLIP: contrast sensitivity and feature detection, as products of one-dimensional ones.
 * Used by flip.c. */
#ifndef DPL_METRIC_FLIP_FILTER_H
#define DPL_METRIC_FLIP_FILTER_H

#include "base/context.h"

/* What is filtered: the three planes of an opponent colour space. */
enum { DPL_FLIP_Y, DPL_FLIP_CX, DPL_FLIP_CZ, DPL_FLIP_PLANES };

/* What comes out per pixel: the filtered colour, and two derivatives each for edges and for points. */
enum {
    DPL_FLIP_COLOR = 0, /* followed by the planes in their order */
    DPL_FLIP_EDGE_X = DPL_FLIP_PLANES,
    DPL_FLIP_EDGE_Y,
    DPL_FLIP_POINT_X,
    DPL_FLIP_POINT_Y,
    DPL_FLIP_RESPONSES
};

/* One-dimensional filters; each has 2 * radius + 1 weights. */
enum {
    DPL_FLIP_GAUSSIAN_A,
    DPL_FLIP_GAUSSIAN_RG,
    DPL_FLIP_GAUSSIAN_BY1,
    DPL_FLIP_GAUSSIAN_BY2,
    DPL_FLIP_SMOOTH,
    DPL_FLIP_FIRST,
    DPL_FLIP_SECOND,
    DPL_FLIP_FILTERS
};

typedef struct dpl_flip_filter {
    int32_t radius; /* [px] */
    double *weights;
} dpl_flip_filter;

typedef struct dpl_flip_filters {
    dpl_flip_filter filter[DPL_FLIP_FILTERS];
    double share[DPL_FLIP_FILTERS]; /* of a contrast filter in its plane's sum; 1 elsewhere */
    int32_t radius_max;             /* [px] */
    dpl_buffer memory;
} dpl_flip_filters;

/* On failure there is nothing to free. */
DPL_MUST_CHECK dpl_status dpl_flip_filters_create(dpl_context *context, double pixels_per_degree,
                                                  dpl_flip_filters *filters);
void dpl_flip_filters_free(dpl_context *context, dpl_flip_filters *filters);

/* A picture in the opponent space: shape [DPL_FLIP_PLANES][height][width]. */
typedef struct dpl_flip_planes {
    const float *data;
    int32_t width;  /* [px] */
    int32_t height; /* [px] */
} dpl_flip_planes;

/* All responses of row y, shape [DPL_FLIP_RESPONSES][width]; beyond the border the edge pixels repeat.
 * `padded` is room for width + 2 * radius_max values. */
void dpl_flip_filter_row(const dpl_flip_filters *filters, const dpl_flip_planes *planes, int32_t y,
                         double *restrict padded, double *restrict responses);

#endif
