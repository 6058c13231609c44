/** @file
 * How far a picture is from another: PSNR (linear and display), relative RMSE, SSIM, FLIP.
 */
#ifndef DAPPLE_METRIC_H
#define DAPPLE_METRIC_H

#include <dapple/context.h>
#include <dapple/export.h>
#include <dapple/image.h>
#include <dapple/status.h>
#include <stdint.h>
#include <string.h>

#ifdef __cplusplus
extern "C" {
#endif

/** Two pictures to compare. Start from dpl_metrics_desc_default(). */
typedef struct dpl_metrics_desc {
    uint32_t struct_size; /**< stamped by the default function */
    uint32_t cookie;      /**< stamped by the default function */
    dpl_pixels test; /**< the picture that is judged: DPL_FORMAT_F32, 3 or 4 channels (alpha is left out) */
    dpl_pixels reference;     /**< the truth: same size and format rules */
    const uint8_t *mask;      /**< shape [height][width]: non-zero pixels are left out; NULL: none */
    ptrdiff_t mask_stride;    /**< from a row of the mask to the next [byte]; 0: tightly packed */
    int32_t display_referred; /**< 0 (default): linear radiance. 1: values are display colours 0 .. 1 (sRGB)
                                 that were tone-mapped already, as read from a PNG */
    double pixels_per_degree; /**< of visual angle, for FLIP, above 0 to 10000, default 67.02 */
} dpl_metrics_desc;

/** Defaults: linear pictures, no mask, FLIP's usual viewing distance. */
static inline dpl_metrics_desc dpl_metrics_desc_default(void) {
    dpl_metrics_desc desc;
    memset(&desc, 0, sizeof desc);
    desc.struct_size = (uint32_t)sizeof desc;
    desc.cookie = DPL_DESC_COOKIE;
    desc.pixels_per_degree = 67.020643;
    return desc;
}

/** Results. */
typedef struct dpl_metrics {
    double psnr_linear;  /**< [dB], peak 1, unclamped linear values; INFINITY when identical */
    double psnr_display; /**< [dB], peak 255, after the tone map and rounding to 8 bits; INFINITY when
                            identical */
    double rel_rmse;     /**< rms error / mean of the reference, linear, over pixels and channels. 0 when
                            identical;     INFINITY when they differ and the reference is black */
    double ssim;         /**< mean structural similarity of display luminance, -1 .. 1 */
    double flip;         /**< mean LDR-FLIP of the tone-mapped pictures, 0 .. 1 */
    int64_t pixels;      /**< pixels that were compared */
} dpl_metrics;

/**
 * Compares two pictures. Masked pixels take no part: their error is zero and they do not count in any mean.
 * @param metrics receives the results
 * @return DPL_OK; DPL_ERROR_DESC, _ARGUMENT (also when every pixel is masked, or a value is not finite),
 * _SIZE, _MEMORY Sources: SSIM: Wang, Bovik, Sheikh, Simoncelli 2004. FLIP: Andersson et al. 2020.
 */
DPL_API DPL_MUST_CHECK dpl_status dpl_metrics_compare(dpl_context *context, const dpl_metrics_desc *desc,
                                                      dpl_metrics *metrics);

#ifdef __cplusplus
}
#endif
#endif
