/* Straight lines through measurements. Used by reports that say how a cost grows. */
#ifndef DPL_BENCH_FIT_H
#define DPL_BENCH_FIT_H

#include <stdint.h>

typedef struct dpl_bench_fit {
    double slope;
    double half_width; /* of the slope's 95 % confidence interval */
    double offset;     /* at x = 0 */
    double r2;         /* share of the variance that the line explains */
} dpl_bench_fit;

/* Least squares; at least 3 points whose x differ. */
dpl_bench_fit dpl_bench_fit_line(const double *x, const double *y, int32_t count);

#endif
