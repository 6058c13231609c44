/* What a display shows: rows of linear radiance or of display colours as 8 bits. Used by the metrics and by
 * dpl_tonemap(). */
#ifndef DPL_METRIC_DISPLAY_H
#define DPL_METRIC_DISPLAY_H

#include "kernel/kernel.h"

/* Tone-maps a row of `width` pixels with 3 or 4 channels (a fourth is left out) to RGB bytes. */
void dpl_tonemap_row(const dpl_kernels *kernels, const float *row, int32_t channels, int32_t width,
                     uint8_t *rgb);

/* The same for a row that is display colours 0 .. 1 already: rounded and clamped. */
void dpl_quantise_row(const float *row, int32_t channels, int32_t width, uint8_t *rgb);

#endif
