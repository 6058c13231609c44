/* A shaft: all straight lines from the points of a box whose directions lie between two. Which triangles can
 * any of them meet? One walk through the hierarchy for all rays from neighbouring receivers to a light with a
 * size. Called by src/shadow/.
 *
 * At t along its way the shaft is the box from low + t least to high + t most, and it meets a box where the
 * two overlap along every axis: per axis two inequalities in t, as slabs are for a ray. */
#ifndef DPL_BVH_SHAFT_H
#define DPL_BVH_SHAFT_H

#include "bvh/triangle.h"

typedef struct dpl_shaft {
    float low[3]; /* of the points where lines begin, along each axis */
    float high[3];
    float least[3]; /* of directions, along each axis */
    float most[3];
    float far; /* largest t, finite */
} dpl_shaft;

/* Is handed slots of triangles, at most DPL_SHAFT_BATCH; returns true to end the walk. */
typedef bool dpl_shaft_visit(void *visitor, const int32_t *slots, int32_t count);

#define DPL_SHAFT_BATCH 64

/* Hands over every triangle whose box the shaft meets, in no particular but always the same order. The set
 * has a hierarchy. */
void dpl_shaft_walk(const dpl_triangles *set, const dpl_shaft *shaft, dpl_shaft_visit *visit, void *visitor,
                    dpl_walk_counts *counts);

#endif
