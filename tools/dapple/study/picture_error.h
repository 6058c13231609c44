/* Errors of pictures, for the thousands of comparisons of a study: what dpl_metrics_compare() calls
 * psnr_display, psnr_linear and rel_rmse, without its slower measures. Used by scene_run.c. */
#ifndef DPL_STUDY_PICTURE_ERROR_H
#define DPL_STUDY_PICTURE_ERROR_H

#include <stddef.h>
#include <stdint.h>

/* psnr_display of two tone-mapped pictures of `bytes` values [dB]; INFINITY when they are equal. */
double dpl_study_psnr_display(const uint8_t *test, const uint8_t *reference, size_t bytes);

/* Linear error over the pixels that `masked` (may be NULL) does not leave out. */
typedef struct dpl_study_linear_error {
    double mean_squared;   /* over pixels and channels */
    double reference_mean; /* likewise */
} dpl_study_linear_error;

/* Of two RGB pictures of `pixels` pixels. At least one must take part. */
dpl_study_linear_error dpl_study_compare_linear(const float *test, const float *reference,
                                                const uint8_t *masked, size_t pixels);

/* [dB]; INFINITY without error. */
double dpl_study_psnr_linear(const dpl_study_linear_error *error, double peak);

/* rms error / mean of the reference. 0 without error, INFINITY when the reference is black. */
double dpl_study_rel_rmse(const dpl_study_linear_error *error);

/* Largest value of a picture of `values` floats, at least 0. */
double dpl_study_peak(const float *picture, size_t values);

#endif
