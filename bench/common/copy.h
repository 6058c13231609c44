/* How fast the machine copies memory: what estimates of bytes moved are held against. Used by bench_speed and
 * by the timing of kernels. */
#ifndef DPL_BENCH_COPY_H
#define DPL_BENCH_COPY_H

#include "../../image/error.h"

#include <stddef.h>

/* Copies between two buffers that a run keeps. Zero-initialise; free with dpl_bench_copy_free(). */
typedef struct dpl_bench_copy {
    unsigned char *from;
    unsigned char *to;
    size_t bytes; /* of each */
    double best;  /* read and written together [GB/s]; greatest so far */
} dpl_bench_copy;

/* The size decides which cache the buffers stay in: DPL_BENCH_COPY_MEMORY is for none of a core's own. */
#define DPL_BENCH_COPY_MEMORY ((size_t)64 << 20)

bool dpl_bench_copy_create(dpl_bench_copy *copy, size_t bytes, dpl_error *error);
void dpl_bench_copy_free(dpl_bench_copy *copy);

/* Copies 64 MiB in all, under the stopwatch. */
void dpl_bench_copy_run(dpl_bench_copy *copy);

#endif
