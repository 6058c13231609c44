/* How fast the machine copies memory: what estimates of bytes moved are held against. Used by main.c. */
#ifndef DPL_BENCH_COPY_H
#define DPL_BENCH_COPY_H

#include "../../image/error.h"

/* Copies from 64 MiB to 64 MiB that a run keeps. Zero-initialise; free with dpl_bench_copy_free(). */
typedef struct dpl_bench_copy {
    unsigned char *from;
    unsigned char *to;
    double best; /* read and written together [GB/s]; greatest so far */
} dpl_bench_copy;

bool dpl_bench_copy_create(dpl_bench_copy *copy, dpl_error *error);
void dpl_bench_copy_free(dpl_bench_copy *copy);

/* Copies once, under the stopwatch. */
void dpl_bench_copy_run(dpl_bench_copy *copy);

#endif
