/* Shapes of the plane and the rays that meet them, naively or through a hierarchy. Called by the tracer. Safe
 * to ask from several threads at once. */
#ifndef DPL_BVH_SHAPE_H
#define DPL_BVH_SHAPE_H

#include "bvh/walk.h"

#include <dapple/shape.h>

/* A disc, box, segment or polygon as rays read it: one cache line. */
typedef struct dpl_packed_shape {
    dpl_shape_kind kind;
    int32_t object; /* number in the set, from 0 */
    double center[2];
    double axis[2];      /* boxes and segments: unit vector along the first side */
    double half[2];      /* boxes: half sizes; segments: half length and radius; discs: the radius, twice */
    int32_t first_point; /* polygons: in dpl_shapes.points */
    int32_t point_count;
} dpl_packed_shape;

/* Zero-initialise. */
typedef struct dpl_shapes {
    dpl_buffer
        packed; /* dpl_packed_shape, in the order of the leaves; in the order given without a hierarchy */
    dpl_buffer points; /* double[2] */
    dpl_buffer bounds; /* dpl_bounds, in the order given */
    dpl_bvh bvh;       /* empty without a hierarchy */
    int32_t count;
    int32_t first_object; /* hits carry this plus the number in the set */
    bool has_tree;
} dpl_shapes;

/* Copies shapes that have been checked, corners of polygons included, and, where asked to, sorts them: as
 * dpl_bvh_update() does. Allocates only when there is more than ever before. On failure nothing is kept. */
DPL_MUST_CHECK dpl_status dpl_shapes_set(dpl_context *context, dpl_shapes *set, const dpl_shape *shapes,
                                         int32_t count, bool tree);

void dpl_shapes_free(dpl_context *context, dpl_shapes *set);

/* The nearest hit that is nearer than `hit` already is: begin with dpl_hit_none(). A ray that starts inside a
 * shape hits it where it starts. Of equal t the shape of the highest number wins: it lies on top. */
void dpl_shapes_closest(const dpl_shapes *set, const dpl_ray *ray, dpl_hit *hit, dpl_walk_counts *counts);

/* Is anything hit? */
bool dpl_shapes_occluded(const dpl_shapes *set, const dpl_ray *ray, dpl_walk_counts *counts);

#endif
