/* Runs of pixels of any format as floats. Used by layer.c and by src/api/lightmap.c. */
#ifndef DPL_FIELD_READER_H
#define DPL_FIELD_READER_H

#include "kernel/kernel.h"

#include <dapple/image.h>
#include <stdbool.h>

/* Pixels that are read at a time: what a run holds fits the innermost cache. */
#define DPL_RUN 128

/* What 8-bit channels stand for. */
typedef struct dpl_byte_values {
    float colour[256];
    float alpha[256]; /* the last of 2 or 4 channels */
} dpl_byte_values;

/* Fills in the values of an 8-bit format; does nothing for another. */
void dpl_byte_values_fill(dpl_byte_values *values, dpl_format format);

/* Reads `count` (at most DPL_RUN) pixels of row y from column x on, channels interleaved as they lie. The
 * stride is explicit; no address needs to be aligned. `values` is read for 8-bit formats. */
void dpl_read_run(const dpl_kernels *kernels, const dpl_pixels *pixels, const dpl_byte_values *values,
                  int32_t x, int32_t y, int32_t count, float *out);

static inline bool dpl_pixels_have_alpha(const dpl_pixels *pixels) {
    return pixels->channels == 2 || pixels->channels == 4;
}

#endif
