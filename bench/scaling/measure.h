/* Time and memory of whole frames at one size. Used by main.c and report.c. */
#ifndef DPL_BENCH_MEASURE_H
#define DPL_BENCH_MEASURE_H

#include "../../scenes/families.h"
#include "../common/memory.h"
#include "../common/summary.h"

#include <dapple/dapple.h>

/* The scene that is drawn at every size, and how often. */
typedef struct dpl_bench_subject {
    const dpl_scene_family *family;
    uint64_t seed;
    int32_t scene;
    int32_t frames; /* measured, after one that is not */
} dpl_bench_subject;

/* One way to run it. */
typedef struct dpl_bench_case {
    dpl_merge merge;
    int32_t threads;
    int32_t size; /* [px] */
} dpl_bench_case;

/* The parts of a frame. */
typedef enum dpl_bench_part {
    DPL_BENCH_DRAW,     /* shapes into the field */
    DPL_BENCH_DISTANCE, /* distance transform, with one copy of its result */
    DPL_BENCH_SOLVE,    /* all the rest */
    DPL_BENCH_PARTS
} dpl_bench_part;

/* What one case took. */
typedef struct dpl_bench_measurement {
    dpl_bench_case which;
    int32_t levels;
    int64_t rays;
    dpl_bench_summary wall_ms[DPL_BENCH_PARTS];
    dpl_bench_summary cpu_ms[DPL_BENCH_PARTS]; /* over all threads */
    int64_t solver_bytes;                      /* as the solver says */
    int64_t total_bytes;       /* most that context, field and solver held together, counted */
    int64_t later_allocations; /* after the first frame, counted */
} dpl_bench_measurement;

/* All that one case needs to draw frames. Zero-initialise; free with dpl_bench_rig_free(). */
typedef struct dpl_bench_rig {
    dpl_bench_case which;
    int32_t frames;
    dpl_bench_memory memory;
    int64_t first_allocations; /* until the end of the first frame */
    dpl_scene scene;
    dpl_context *context;
    dpl_field *field;
    dpl_solver *solver;
    dpl_picture picture;
    float *distance;
    double *times; /* shape [2][DPL_BENCH_PARTS][frames]: wall, then processor [ms] */
} dpl_bench_rig;

/* Everything but the first frame. The rig must not be moved afterwards. */
bool dpl_bench_rig_create(const dpl_bench_subject *subject, const dpl_bench_case *which, dpl_bench_rig *rig,
                          dpl_error *error);

void dpl_bench_rig_free(dpl_bench_rig *rig);

/* Draws one frame. The first, number -1, allocates what is missing and is not measured; then come 0 ..
 * frames-1. */
bool dpl_bench_rig_frame(dpl_bench_rig *rig, int32_t frame, dpl_error *error);

/* What the frames took, after the last one. Sorts the rig's times. */
dpl_bench_measurement dpl_bench_rig_read(dpl_bench_rig *rig);

#endif
