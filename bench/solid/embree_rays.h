/* Embree on the receivers of bench_solid: as a second opinion on the truth, and as a contestant. */
#ifndef DPL_BENCH_SOLID_EMBREE_RAYS_H
#define DPL_BENCH_SOLID_EMBREE_RAYS_H

#include "../tracers/embree.h"

#include <dapple/solid_shadow.h>

/* Most points of a disc. */
#define DPL_BENCH_MOST_POINTS 576

/* Where rays to a light end: points of the unit disc. */
typedef struct dpl_bench_sampling {
    int32_t count;
    bool packets; /* 16 rays at once; count is a multiple of that */
    float at[DPL_BENCH_MOST_POINTS][2];
} dpl_bench_sampling;

/* 24 x 24 points of a grid on the square, moved to the disc: another sampling than the library's. */
dpl_bench_sampling dpl_bench_sampling_grid(void);

/* The library's own: turned by the golden angle from point to point. */
dpl_bench_sampling dpl_bench_sampling_spiral(int32_t count);

/* The share of the points of a spot light that each of `count` receivers, which look up, sees. */
void dpl_bench_embree_see(dpl_bench_embree *embree, const dpl_bench_sampling *sampling,
                          const dpl_solid_light *light, const float (*positions)[3], int32_t count,
                          float *visibility);

#endif
