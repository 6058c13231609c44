/** @file
 * Correlation of two series, with its uncertainty.
 */
#ifndef DAPPLE_CORRELATION_H
#define DAPPLE_CORRELATION_H

#include <dapple/export.h>
#include <dapple/status.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/** Pearson's r with its 95 % confidence interval and p-value. */
typedef struct dpl_correlation {
    double r;    /**< -1 .. 1; 0 when either series is constant */
    double low;  /**< lower end of the interval by Fisher's z: tanh(atanh(r) - 1.959964 / sqrt(n - 3)); -1 for
                    n < 4 */
    double high; /**< upper end; 1 for n < 4 */
    double p; /**< two-sided p-value of r = 0 by Student's t with n - 2 degrees of freedom; 1 for n < 3 or a
                   constant series */
    int32_t count; /**< n */
} dpl_correlation;

/**
 * Correlates two series.
 * @param x,y    `count` finite values each
 * @param count  2 or more
 * @param result receives the correlation
 * @return DPL_OK; DPL_ERROR_ARGUMENT. Thread-safe.
 * Source: Fisher 1921; the p-value through the regularised incomplete beta function.
 */
DPL_API DPL_MUST_CHECK dpl_status dpl_correlate(const double *x, const double *y, int32_t count,
                                                dpl_correlation *result);

#ifdef __cplusplus
}
#endif
#endif
