/* Sorts figures and reads off their spread. Called by the reports of both benchmarks. */
#include "summary.h"

#include <stdlib.h>

static int compare(const void *left, const void *right) {
    double a = *(const double *)left, b = *(const double *)right;
    return (a > b) - (a < b);
}

dpl_bench_summary dpl_bench_summarise(double *values, int32_t count) {
    qsort(values, (size_t)count, sizeof *values, compare);
    double low = values[(count - 1) / 2], high = values[count / 2];
    dpl_bench_summary summary = {0, values[0], low == high ? low : (low + high) / 2, values[count - 1]};
    for (int32_t i = 0; i < count; i++)
        summary.mean += values[i] / count;
    return summary;
}
