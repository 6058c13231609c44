/** @file
 * From linear mean radiance to the 8 bits of a display.
 */
#ifndef DAPPLE_TONEMAP_H
#define DAPPLE_TONEMAP_H

#include <dapple/context.h>
#include <dapple/export.h>
#include <dapple/image.h>
#include <dapple/status.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/**
 * Tone-maps a picture: v = 1 - 1/(1 + 2pi m)^2.5 per channel, m the mean radiance, rounded to 8 bits.
 * The result is display-referred: write it to an sRGB file as it is.
 * @param context    for its kernels and threads
 * @param linear     DPL_FORMAT_F32, 3 or 4 channels (a fourth is left out); below 0 or not a number counts as
 * 0
 * @param rgb        receives shape [height][width][3]
 * @param row_stride from a row to the next of `rgb` [byte]; 0: tightly packed
 * @return DPL_OK; DPL_ERROR_ARGUMENT
 * Source: the display transform of the ARC paper's own code.
 */
DPL_API DPL_MUST_CHECK dpl_status dpl_tonemap(dpl_context *context, const dpl_pixels *linear, uint8_t *rgb,
                                              ptrdiff_t row_stride);

#ifdef __cplusplus
}
#endif
#endif
