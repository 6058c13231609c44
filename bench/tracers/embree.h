/* Intel's Embree, to race against: embree.c where the library is there, embree_none.c where not. Used by
 * solid.c and by bench_solid. */
#ifndef DPL_BENCH_EMBREE_H
#define DPL_BENCH_EMBREE_H

#include "../../image/error.h"

#include <dapple/ray.h>

/* Triangles as both contestants get them. */
typedef struct dpl_bench_mesh {
    float (*vertices)[3];
    int32_t vertex_count;
    int32_t (*indices)[3];
    int32_t count;
} dpl_bench_mesh;

typedef struct dpl_bench_embree dpl_bench_embree;

/* Its version as text; NULL when it was not built in. */
const char *dpl_bench_embree_version(void);

/* Builds with one thread and Embree's defaults, from copies of the mesh. NULL and an error when it fails. */
dpl_bench_embree *dpl_bench_embree_build(const dpl_bench_mesh *mesh, dpl_error *error);

void dpl_bench_embree_free(dpl_bench_embree *embree);

/* One ray after another: rtcIntersect1 and rtcOccluded1. */
void dpl_bench_embree_closest(dpl_bench_embree *embree, const dpl_ray *rays, int64_t count, dpl_hit *hits);
void dpl_bench_embree_occluded(dpl_bench_embree *embree, const dpl_ray *rays, int64_t count,
                               uint8_t *occluded);

/* Sixteen rays at once: rtcOccluded16. */
void dpl_bench_embree_occluded_16(dpl_bench_embree *embree, const dpl_ray rays[16], uint8_t occluded[16]);

#endif
