/* A run of probes in a row while one slot of them is being solved. Chosen and stored by level.c, traced by
 * chunk.c. */
#ifndef DPL_CASCADE_CHUNK_H
#define DPL_CASCADE_CHUNK_H

#include "cascade/level.h"

#define DPL_CHUNK_RUNS 4 /* rays of every probe that are marched at once: of a slot, or to the parents */
#define DPL_CHUNK_PARENTS (DPL_CHUNK / 2 + 2 + DPL_PARENTS_SPARE)
#define DPL_CACHE_LINE 64 /* [byte] */
#define DPL_CHUNK_BATCH (DPL_CHUNK_RUNS * DPL_CHUNK)

/* A run of probes in a row, and everything that is computed for it. Every ray of a slot and row shares the
 * first part. */
typedef struct dpl_chunk {
    /* A vector's loads that cross two lines of a cache take twice as long. */
    _Alignas(DPL_CACHE_LINE) float x[DPL_CHUNK]; /* where the probes stand [px] */
    float parent_x[2][DPL_CHUNK];                /* where their left and right parents stand [px] */
    /* Of the rays that are marched at once, run after run of `count`. */
    float x0[DPL_CHUNK_BATCH], y0[DPL_CHUNK_BATCH];
    float x1[DPL_CHUNK_BATCH], y1[DPL_CHUNK_BATCH];
    float radiance[3][DPL_CHUNK_BATCH], transmittance[3][DPL_CHUNK_BATCH];
    float sum[3][DPL_CHUNK];
    /* Of the run at hand. */
    float mean[2][3][DPL_CHUNK_PARENTS]; /* rows of parents, where a ray sees the mean of several slots */
    float shares[2];                     /* of its slot that a ray is: even probes, odd probes */
    int32_t at;                          /* the first of the run among the rays above */
    int32_t first;                       /* probe, even */
    int32_t count;
    int32_t row;
    /* Of the rays at hand, where there is a survey or little has changed. */
    uint64_t needed[DPL_CHUNK_WORDS], live[DPL_CHUNK_WORDS], hits[DPL_CHUNK_WORDS];
    const int32_t *cells; /* of the next hits */
} dpl_chunk;

/* Puts the probes and their parents where they stand, and sets the sums to 0. `first`, `count` and `row` are
 * given. */
void dpl_chunk_prepare(const dpl_level *level, dpl_chunk *chunk);

/* Adds what all groups of a slot see to the chunk's sums, and to `rays` how many were marched. */
void dpl_chunk_trace(const dpl_level *level, dpl_chunk *chunk, const dpl_ray_group groups[DPL_CHUNK_RUNS],
                     int32_t count, int64_t *rays);

#endif
