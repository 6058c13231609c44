/* Stands in for embree.c where Embree is not installed. */
#include "embree.h"

#include <stddef.h>

const char *dpl_bench_embree_version(void) {
    return NULL;
}

dpl_bench_embree *dpl_bench_embree_build(const dpl_bench_mesh *mesh, dpl_error *error) {
    (void)mesh;
    dpl_error_set(error, "Embree was not built in");
    return NULL;
}

void dpl_bench_embree_free(dpl_bench_embree *embree) {
    (void)embree;
}

void dpl_bench_embree_closest(dpl_bench_embree *embree, const dpl_ray *rays, int64_t count, dpl_hit *hits) {
    (void)embree, (void)rays;
    for (int64_t i = 0; i < count; i++)
        hits[i] = dpl_hit_none();
}

void dpl_bench_embree_occluded(dpl_bench_embree *embree, const dpl_ray *rays, int64_t count,
                               uint8_t *occluded) {
    (void)embree, (void)rays;
    for (int64_t i = 0; i < count; i++)
        occluded[i] = 0;
}

void dpl_bench_embree_occluded_16(dpl_bench_embree *embree, const dpl_ray rays[16], uint8_t occluded[16]) {
    dpl_bench_embree_occluded(embree, rays, 16, occluded);
}
