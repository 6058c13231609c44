/* Triangles and the rays that meet them, naively or through a hierarchy. Called by the tracer and by whoever
 * casts shadows of meshes. Safe to ask from several threads at once. */
#ifndef DPL_BVH_TRIANGLE_H
#define DPL_BVH_TRIANGLE_H

#include "bvh/walk.h"

/* A triangle as rays read it. */
typedef struct dpl_triangle {
    float corner[3][3];
    int32_t object; /* number in the set, from 0 */
} dpl_triangle;

/* Zero-initialise. */
typedef struct dpl_triangles {
    dpl_buffer packed; /* dpl_triangle, in the order of the leaves; in the order given without a hierarchy */
    dpl_buffer bounds; /* dpl_bounds, in the order given */
    dpl_bvh bvh;       /* empty without a hierarchy */
    int32_t count;
    int32_t first_object; /* hits carry this plus the number in the set */
    bool has_tree;
} dpl_triangles;

/* What to keep. Coordinates are finite and within 1e9; indices are corners that exist. */
typedef struct dpl_triangles_source {
    const float (*vertices)[3];
    const int32_t (*indices)[3]; /* NULL: three vertices after another are a triangle */
    int32_t count;               /* triangles */
} dpl_triangles_source;

/* Copies triangles and, where asked to, sorts them: as dpl_bvh_update() does, so the same triangles at other
 * places are cheap. Allocates only when there are more than ever before. On failure nothing is kept. */
DPL_MUST_CHECK dpl_status dpl_triangles_set(dpl_context *context, dpl_triangles *set,
                                            const dpl_triangles_source *source, bool tree);

void dpl_triangles_free(dpl_context *context, dpl_triangles *set);

/* The nearest hit that is nearer than `hit` already is: begin with dpl_hit_none(). Of equal t the triangle of
 * the highest number wins. Both sides of a triangle are hit; one seen edge on is not. */
void dpl_triangles_closest(const dpl_triangles *set, const dpl_ray *ray, dpl_hit *hit,
                           dpl_walk_counts *counts);

/* Is anything hit? */
bool dpl_triangles_occluded(const dpl_triangles *set, const dpl_ray *ray, dpl_walk_counts *counts);

#endif
