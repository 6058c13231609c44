/* Ordinary least squares with Student's interval. Called by reports. */
#include "fit.h"

#include <math.h>

/* Student's t, 97.5 %, for 1, 2, 3 ... degrees of freedom; beyond the table an approximation good to 0.3 %.
 */
static double student(int32_t freedom) {
    static const double table[] = {12.706, 4.303, 3.182, 2.776, 2.571, 2.447, 2.365, 2.306, 2.262, 2.228};
    int32_t known = (int32_t)(sizeof table / sizeof table[0]);
    return freedom <= known ? table[freedom - 1] : 1.96 + 2.5 / freedom;
}

dpl_bench_fit dpl_bench_fit_line(const double *x, const double *y, int32_t count) {
    double mean_x = 0, mean_y = 0, xx = 0, xy = 0, yy = 0;
    for (int32_t i = 0; i < count; i++) {
        mean_x += x[i] / count;
        mean_y += y[i] / count;
    }
    for (int32_t i = 0; i < count; i++) {
        xx += (x[i] - mean_x) * (x[i] - mean_x);
        xy += (x[i] - mean_x) * (y[i] - mean_y);
        yy += (y[i] - mean_y) * (y[i] - mean_y);
    }
    dpl_bench_fit fit = {.slope = xy / xx};
    fit.offset = mean_y - fit.slope * mean_x;
    double rest = fmax(0.0, yy - fit.slope * xy);
    fit.half_width = student(count - 2) * sqrt(rest / (count - 2) / xx);
    fit.r2 = yy > 0.0 ? 1.0 - rest / yy : 1.0;
    return fit;
}
