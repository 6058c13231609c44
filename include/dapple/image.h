/** @file
 * Views of pixels that the caller owns: how pictures enter the library and how results leave it.
 */
#ifndef DAPPLE_IMAGE_H
#define DAPPLE_IMAGE_H

#include <dapple/export.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/** How one channel of a picture is stored. */
typedef enum dpl_format {
    DPL_FORMAT_F32 = 0,    /**< float, linear */
    DPL_FORMAT_UNORM8 = 1, /**< uint8_t, linear, 255 = 1 */
    DPL_FORMAT_SRGB8 = 2,  /**< uint8_t, sRGB-encoded colour; a fourth channel (alpha) is linear */
    DPL_FORMAT_F16 = 3     /**< uint16_t with the bits of an IEEE 754 half, linear: what GPUs call R16F,
                              RGBA16F, .. */
} dpl_format;

/** A picture to read. Rows top to bottom, pixels left to right, channels interleaved. */
typedef struct dpl_pixels {
    const void *data;     /**< first channel of the top left pixel */
    dpl_format format;    /**< of each channel */
    int32_t width;        /**< [px] */
    int32_t height;       /**< [px] */
    int32_t channels;     /**< 1 .. 4 per pixel */
    ptrdiff_t row_stride; /**< from a row to the next [byte]; 0: tightly packed; may be negative */
} dpl_pixels;

/** A picture to write. Rows top to bottom; row_stride may be negative to flip. Name its members when you
 * initialise it: members may be added. */
typedef struct dpl_output {
    void
        *data; /**< first channel of the top left pixel, shape [height][width][channels]; aligned to a channel
                */
    dpl_format format;    /**< of each channel; what a function takes is said there */
    int32_t width;        /**< [px] */
    int32_t height;       /**< [px] */
    int32_t channels;     /**< per pixel, 3 (RGB) or 4 (RGB and alpha) */
    ptrdiff_t row_stride; /**< from a row to the next [byte]; 0: tightly packed */
} dpl_output;

#ifdef __cplusplus
}
#endif
#endif
