/* Reading dpl_pixels of floats that the caller owns: checks and rows. Used by the metrics and by
 * dpl_tonemap(). */
#ifndef DPL_METRIC_VIEW_H
#define DPL_METRIC_VIEW_H

#include "base/context.h"

#include <dapple/image.h>

/* Refuses what cannot be read as rows of RGB or RGBA floats. `name` starts the message ("test picture");
 * `size_status` is what a width or height out of range counts as. */
DPL_MUST_CHECK dpl_status dpl_view_check(dpl_context *context, const char *name, const dpl_pixels *pixels,
                                         dpl_status size_status);

/* The step from a row to the next: `tight` bytes for 0, else the stride itself. */
ptrdiff_t dpl_stride_or_tight(ptrdiff_t stride, ptrdiff_t tight);

/* Is a row of `tight` bytes no longer than the step to the next, in either direction? */
bool dpl_stride_holds(ptrdiff_t stride, ptrdiff_t tight);

/* First channel of the leftmost pixel of a row. */
const float *dpl_view_row(const dpl_pixels *pixels, int32_t y);

#endif
