/* The signed distance at coarser spacings: level k has one value per square of 2^k pixels, the mean of its
 * pixels' distances. Level 0 is the solid's own plane. Marches read it between values. Kept with the solid.
 */
#ifndef DPL_SHADOW_MIPS_H
#define DPL_SHADOW_MIPS_H

#include "shadow/solid.h"

#define DPL_MIPS_MOST 4 /* levels above 0 */

typedef struct dpl_mips {
    dpl_buffer levels[DPL_MIPS_MOST];
    uint64_t revision; /* of the solid */
    int32_t level;     /* highest that is filled */
} dpl_mips;

/* A level to read. */
typedef struct dpl_distances {
    const float *data; /* shape [height][width] */
    int32_t width, height;
    float scale; /* values per pixel along an axis: 1 / 2^level */
    float loss;  /* DPL_CORNER_LOSS [px] */
} dpl_distances;

DPL_MUST_CHECK dpl_status dpl_mips_update(dpl_mips *mips, dpl_context *context, const dpl_solid *solid,
                                          int32_t level);
void dpl_mips_free(dpl_context *context, dpl_mips *mips);
dpl_distances dpl_mips_level(const dpl_mips *mips, const dpl_solid *solid, int32_t level);

/* What interpolation loses at corners. The value at the corner of a solid is 0, but the mean of the four
 * centres around it is (0.5 + 0.5 + 0.71 - 0.5) / 4 = 0.30, while at a straight edge it is 0: a staircase of
 * pixels would shrink. This middle value [spacing] is taken off everywhere. Measured over the family
 * "shadows": the error of four cones falls by half against 0. */
#define DPL_CORNER_LOSS 0.2f

/* Where a point lies among four values: the first one's index, the steps to the next column and row (0 at the
 * border), and the fractions. Outside the picture its border counts. */
typedef struct dpl_cell {
    const float *first;
    int32_t right, below;
    float fx, fy;
} dpl_cell;

static inline dpl_cell dpl_distances_cell(const dpl_distances *d, float x, float y) {
    float u = x * d->scale - 0.5f, v = y * d->scale - 0.5f;
    float last_u = (float)(d->width - 1), last_v = (float)(d->height - 1);
    u = u > 0.0f ? u < last_u ? u : last_u : 0.0f;
    v = v > 0.0f ? v < last_v ? v : last_v : 0.0f;
    int32_t column = (int32_t)u, row = (int32_t)v;
    return (dpl_cell){d->data + (size_t)row * (size_t)d->width + (size_t)column,
                      column + 1 < d->width ? 1 : 0, row + 1 < d->height ? d->width : 0, u - (float)column,
                      v - (float)row};
}

/* Signed distance at a point [px]. */
static inline float dpl_distances_at(const dpl_distances *d, float x, float y) {
    dpl_cell c = dpl_distances_cell(d, x, y);
    const float *below = c.first + c.below;
    float top = c.first[0] + c.fx * (c.first[c.right] - c.first[0]);
    float bottom = below[0] + c.fx * (below[c.right] - below[0]);
    return top + c.fy * (bottom - top) - d->loss;
}

/* The same, with the direction in which it grows (not scaled). */
static inline float dpl_distances_slope(const dpl_distances *d, float x, float y, float slope[2]) {
    dpl_cell c = dpl_distances_cell(d, x, y);
    const float *below = c.first + c.below;
    float top = c.first[c.right] - c.first[0], bottom = below[c.right] - below[0];
    float first = c.first[0] + c.fx * top, second = below[0] + c.fx * bottom;
    slope[0] = top + c.fy * (bottom - top);
    slope[1] = second - first;
    return first + c.fy * (second - first) - d->loss;
}

#endif
