/* Trials of whole pictures in which a few shapes move among many that do not. Used by main.c and report.c. */
#ifndef DPL_BENCH_FRAME_H
#define DPL_BENCH_FRAME_H

#include "trial.h"

enum { DPL_BENCH_FRAME_STATICS = 5000, DPL_BENCH_FRAME_SIZE = 128, DPL_BENCH_FRAME_DIRECTIONS = 64 };

typedef struct dpl_bench_frame_world dpl_bench_frame_world;

/* Zero-initialise. */
typedef struct dpl_bench_frame {
    dpl_context *context;
    dpl_bench_frame_world *worlds;
    int32_t count;
    int64_t kept_bytes; /* that a tracer holds which keeps static hits */
} dpl_bench_frame;

/* Adds, for 1, 10 and 100 moving shapes, a trial that traces everything anew and one that keeps static hits.
 * Each run places the moving shapes and lights a picture; the two must be equal bit for bit. The trials point
 * into `frame`. */
bool dpl_bench_frame_prepare(dpl_bench_frame *frame, dpl_bench_trials *trials, dpl_error *error);

void dpl_bench_frame_free(dpl_bench_frame *frame);

#endif
