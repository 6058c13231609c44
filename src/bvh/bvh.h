/* A hierarchy of axis-aligned boxes: which objects can a ray meet? Built by build.c and collapse.c, walked by
 * walk.h, moved by refit.c. It knows boxes only; triangle.c and shape.c know what is in them.
 *
 * Flat worlds use the same nodes with a third axis of nothing, which their rays do not look at. */
#ifndef DPL_BVH_BVH_H
#define DPL_BVH_BVH_H

#include "base/context.h"

/* The deepest that it gets: DPL_BVH_SAH_DEPTH levels by cost, then 23 by halves, from 2^27 objects to 16, and
 * 5 to single ones. */
#define DPL_BVH_SAH_DEPTH 36
#define DPL_BVH_MAX_DEPTH (DPL_BVH_SAH_DEPTH + 28)

/* Closed; nothing when low > high. */
typedef struct dpl_bounds {
    float low[3];
    float high[3];
} dpl_bounds;

#define DPL_BVH_CHILDREN 4

/* The boxes of four children side by side. Every object has a box of its own: a leaf is one object. Where
 * there are fewer children, the last boxes are empty and no ray enters them. Two cache lines; flat worlds
 * read the first and a part of the second. */
typedef struct dpl_bvh_node {
    float planes[3][2][DPL_BVH_CHILDREN]; /* [axis][low, high][child] */
    int32_t child[DPL_BVH_CHILDREN];      /* >= 0: a node; below 0: ~slot of an object */
    int32_t child_count;
    int32_t unused[3]; /* fills the lines */
} dpl_bvh_node;

/* Zero-initialise. Parents come before their children; the root is node 0. */
typedef struct dpl_bvh {
    dpl_buffer nodes;   /* dpl_bvh_node; none without objects */
    dpl_buffer objects; /* int32_t per slot: number of the object. Slots are in the order of the leaves */
    dpl_buffer scratch; /* of building: objects being sorted */
    dpl_buffer pairs;   /* of building: dpl_bvh_pair, the tree with two children to a node */
    int32_t axes;       /* 2 for a flat world, else 3 */
    int32_t object_count;
    int32_t node_count;
    int32_t depth;        /* nodes on the longest way down */
    double cost;          /* expected node visits of a ray through the root's box */
    double cost_at_build; /* of the last dpl_bvh_build() */
    int32_t builds;       /* so far */
    int32_t refits;       /* so far, without those that led to a build */
} dpl_bvh;

/* The nodes: where the memory for them first lies on a pair of cache lines, which processors fetch together.
 */
static inline dpl_bvh_node *dpl_bvh_nodes(const dpl_bvh *bvh) {
    uintptr_t at = (uintptr_t)bvh->nodes.data, size = sizeof(dpl_bvh_node);
    return (dpl_bvh_node *)((at + size - 1) / size * size);
}

/* A node of the tree that is built first. */
typedef struct dpl_bvh_pair {
    dpl_bounds bounds;
    int32_t child[2]; /* >= 0: a pair; below 0: ~slot of an object */
    int32_t count;    /* objects below */
} dpl_bvh_pair;

/* Sorts objects by their boxes, shape [count], finite. `axes` is 2 or 3. Deterministic. Allocates only when
 * there are more objects than ever before. On failure the hierarchy is empty. */
DPL_MUST_CHECK dpl_status dpl_bvh_build(dpl_context *context, dpl_bvh *bvh, int32_t axes,
                                        const dpl_bounds *bounds, int32_t count);

/* Fits the boxes of the tree around objects that have moved: much cheaper than to build, and worse the
 * farther they moved, as `cost` beside `cost_at_build` says. `bounds` are of all objects, by number. */
void dpl_bvh_refit(dpl_bvh *bvh, const dpl_bounds *bounds);

/* Refits a tree of as many objects, unless that makes it much worse than it was when built; else builds. */
DPL_MUST_CHECK dpl_status dpl_bvh_update(dpl_context *context, dpl_bvh *bvh, int32_t axes,
                                         const dpl_bounds *bounds, int32_t count);

/* collapse.c: makes the nodes of what build.c has left in `pairs`; pair 0 is the root. Boxes are not set. */
void dpl_bvh_collapse(dpl_bvh *bvh);

void dpl_bvh_free(dpl_context *context, dpl_bvh *bvh);

/* ---- boxes ---------------------------------------------------------------------------------------- */

dpl_bounds dpl_bounds_empty(void);
void dpl_bounds_add_point(dpl_bounds *bounds, const float point[3]);
void dpl_bounds_add(dpl_bounds *bounds, const dpl_bounds *other);

/* How likely a random line meets a box, up to a factor: half its surface, or for two axes half its perimeter.
 */
float dpl_bounds_half_area(const dpl_bounds *bounds, int32_t axes);

/* A little larger on every side of the first `axes`, so that a ray within a flat box meets it. */
void dpl_bounds_pad(dpl_bounds *bounds, int32_t axes);

#endif
