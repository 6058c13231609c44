/* A shaft: all straight lines from a point whose directions lie between two. Which triangles can any of them
 * meet? One walk through the hierarchy for all rays to a light with a size. Called by src/shadow/.
 *
 * At t along its way the shaft is the box from origin + t least to origin + t most, and it meets a box where
 * the two overlap along every axis: per axis two inequalities in t, as slabs are for a ray. */
#ifndef DPL_BVH_SHAFT_H
#define DPL_BVH_SHAFT_H

#include "bvh/triangle.h"

typedef struct dpl_shaft {
    float origin[3];
    float least[3]; /* of directions, along each axis */
    float most[3];
    float far; /* largest t, finite */
} dpl_shaft;

/* Is handed slots of triangles, at most DPL_SHAFT_BATCH; returns true to end the walk. */
typedef bool dpl_shaft_visit(void *visitor, const int32_t *slots, int32_t count);

#define DPL_SHAFT_BATCH 16

/* Hands over every triangle whose box the shaft meets, in no particular but always the same order. The set
 * has a hierarchy. */
void dpl_shaft_walk(const dpl_triangles *set, const dpl_shaft *shaft, dpl_shaft_visit *visit, void *visitor,
                    dpl_walk_counts *counts);

#endif
