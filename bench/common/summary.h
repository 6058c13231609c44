/* Mean, least, median and greatest of a list of figures. Used by the reports. */
#ifndef DPL_BENCH_SUMMARY_H
#define DPL_BENCH_SUMMARY_H

#include <stdint.h>

typedef struct dpl_bench_summary {
    double mean;
    double min;
    double median; /* of an even count: midway between the two in the middle */
    double max;
} dpl_bench_summary;

/* Sorts the values in place. `count` at least 1. */
dpl_bench_summary dpl_bench_summarise(double *values, int32_t count);

#endif
