/* The two pictures of a comparison, as every metric reads them: the checked views, the mask, and what a
 * display shows of both. Made by compare.c. */
#ifndef DPL_METRIC_PAIR_H
#define DPL_METRIC_PAIR_H

#include "base/context.h"

#include <dapple/metric.h>

enum { DPL_PAIR_TEST, DPL_PAIR_REFERENCE, DPL_PAIR_COUNT };

typedef struct dpl_pair {
    int32_t width;  /* [px] */
    int32_t height; /* [px] */
    dpl_pixels pixels[DPL_PAIR_COUNT];
    const uint8_t *mask; /* may be NULL */
    ptrdiff_t mask_stride;
    bool display_referred;
    double pixels_per_degree;
    int64_t free_pixels;              /* pixels that no mask takes out, > 0 */
    uint8_t *display[DPL_PAIR_COUNT]; /* shape [height][width][3]; under the mask both are the reference */
    dpl_buffer memory;
} dpl_pair;

/* Checks the desc and loads both pictures. On failure there is nothing to close. */
DPL_MUST_CHECK dpl_status dpl_pair_open(dpl_context *context, const dpl_metrics_desc *desc, dpl_pair *pair);
void dpl_pair_close(dpl_context *context, dpl_pair *pair);

/* Does pixel (x, y) count? */
bool dpl_pair_is_free(const dpl_pair *pair, int32_t x, int32_t y);

/* A row of what the display shows, shape [width][3]. */
const uint8_t *dpl_pair_display_row(const dpl_pair *pair, int picture, int32_t y);

#endif
