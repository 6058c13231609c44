/* A ray's way through a hierarchy: near child first, with a stack of fixed size. Used by triangle.c and
 * shape.c, which say what happens at an object, and by their naive twins, which ask every object in turn.
 *
 * Why both agree bit for bit. An object can be hit only by a ray that enters its box, at t no less than where
 * it enters. Entering is decided by subtractions, products and comparisons, all of which keep order when they
 * round. So a ray that enters an object's box enters every box around it, in floating point as on paper, and
 * no later. What an object answers does not depend on what was found before, and of equal t the later object
 * wins. Hence the order of visits cannot show.
 *
 * Boxes: Kay and Kajiya 1986; far planes 3 roundings farther, so that a ray cannot slip between boxes that
 * touch: Ize 2013, "Robust BVH ray traversal". */
#ifndef DPL_BVH_WALK_H
#define DPL_BVH_WALK_H

#include "bvh/bvh.h"
#include "kernel/four.h"

#include <dapple/ray.h>

/* What was done, summed over rays. */
typedef struct dpl_walk_counts {
    int64_t object_tests; /* shapes or triangles that were asked */
    int64_t node_visits;  /* nodes of the hierarchy, four boxes each */
} dpl_walk_counts;

/* A ray as boxes want it. */
typedef struct dpl_walk_ray {
    float origin[3];
    float inverse[3];  /* of the direction; never 0 or infinite */
    float to_far[3];   /* the same and a little more, for planes where the ray leaves */
    int32_t behind[3]; /* 1 where the direction is negative: the high plane comes first */
    float near;
    float far; /* finite; the nearest hit so far */
} dpl_walk_ray;

/* False for a ray that hits nothing, as dpl_ray says. */
bool dpl_walk_ray_prepare(const dpl_ray *ray, int32_t axes, dpl_walk_ray *prepared);

static inline float dpl_walk_least(float a, float b) {
    return a < b ? a : b;
}

static inline float dpl_walk_most(float a, float b) {
    return a > b ? a : b;
}

/* Where the ray enters a box; false when it does not between near and far. */
static inline bool dpl_walk_enters(const dpl_bounds *bounds, int32_t axes, const dpl_walk_ray *ray,
                                   float *enter) {
    float in = ray->near, out = ray->far;
    for (int32_t axis = 0; axis < axes; axis++) {
        float low = bounds->low[axis] - ray->origin[axis], high = bounds->high[axis] - ray->origin[axis];
        float first = (ray->behind[axis] ? high : low) * ray->inverse[axis];
        float second = (ray->behind[axis] ? low : high) * ray->to_far[axis];
        in = dpl_walk_most(first, in);
        out = dpl_walk_least(second, out);
    }
    *enter = in;
    return in <= out;
}

/* The same for the boxes of all children of a node: bit `child` of the result, and enter[child], aligned. */
static inline uint32_t dpl_walk_enters_node(const dpl_bvh_node *node, int32_t axes, const dpl_walk_ray *ray,
                                            float enter[DPL_BVH_CHILDREN]) {
    dpl_four in = dpl_four_all(ray->near), out = dpl_four_all(ray->far);
    for (int32_t axis = 0; axis < axes; axis++) {
        dpl_four origin = dpl_four_all(ray->origin[axis]);
        dpl_four first = dpl_four_load(node->planes[axis][ray->behind[axis]]);
        dpl_four second = dpl_four_load(node->planes[axis][1 - ray->behind[axis]]);
        first = dpl_four_multiply(dpl_four_subtract(first, origin), dpl_four_all(ray->inverse[axis]));
        second = dpl_four_multiply(dpl_four_subtract(second, origin), dpl_four_all(ray->to_far[axis]));
        in = dpl_four_most(first, in);
        out = dpl_four_least(second, out);
    }
    dpl_four_store(enter, in);
    return dpl_four_ordered(in, out);
}

/* Asks the object in a slot, whose box the ray enters at `enter`. May shorten ray->far to what it hits.
 * Returns true to end the walk. */
typedef bool dpl_walk_ask(void *asker, int32_t slot, float enter, dpl_walk_ray *ray);

/* Asks every object in turn, where its box is entered: what a walk replaces. */
static inline bool dpl_walk_all(const dpl_bounds *bounds, int32_t count, int32_t axes, dpl_walk_ray *ray,
                                dpl_walk_ask *ask, void *asker, dpl_walk_counts *counts) {
    float enter;
    for (int32_t i = 0; i < count; i++)
        if (dpl_walk_enters(&bounds[i], axes, ray, &enter) && ask(asker, i, enter, ray)) {
            counts->object_tests += i + 1;
            return true;
        }
    counts->object_tests += count;
    return false;
}

/* What is still to be visited. */
typedef struct dpl_walk_entry {
    int32_t child; /* as dpl_bvh_node.child */
    float enter;
} dpl_walk_entry;

/* Puts the children that are entered on the stack, the nearest on top. Returns the stack's new height. All
 * are written, and those that are not entered written over: that is cheaper than to ask which. */
static inline int32_t dpl_walk_push(const dpl_bvh_node *node, uint32_t entered,
                                    const float enter[DPL_BVH_CHILDREN], dpl_walk_entry *stack,
                                    int32_t height) {
    int32_t bottom = height;
    for (int32_t i = 0; i < DPL_BVH_CHILDREN; i++) {
        stack[height] = (dpl_walk_entry){node->child[i], enter[i]};
        height += (int32_t)(entered >> i & 1);
    }
    for (int32_t i = bottom + 1; i < height; i++) {
        dpl_walk_entry entry = stack[i];
        int32_t at = i;
        for (; at > bottom && stack[at - 1].enter < entry.enter; at--)
            stack[at] = stack[at - 1];
        stack[at] = entry;
    }
    return height;
}

/* Walks. Inlined, with `axes` and `ask` known, into each of its few callers. */
static inline bool dpl_walk(const dpl_bvh *bvh, int32_t axes, dpl_walk_ray *ray, dpl_walk_ask *ask,
                            void *asker, dpl_walk_counts *counts) {
    dpl_walk_entry stack[DPL_BVH_MAX_DEPTH * (DPL_BVH_CHILDREN - 1) + 2];
    const dpl_bvh_node *nodes = dpl_bvh_nodes(bvh);
    int32_t height = 0;
    int64_t visits = 0, tests = 0;
    bool ended = false;
    if (bvh->node_count > 0)
        stack[height++] = (dpl_walk_entry){0, ray->near};
    while (height > 0 && !ended) {
        dpl_walk_entry next = stack[--height];
        if (next.enter > ray->far)
            continue;
        if (next.child < 0) {
            tests++;
            ended = ask(asker, ~next.child, next.enter, ray);
        } else {
            _Alignas(16) float enter[DPL_BVH_CHILDREN];
            const dpl_bvh_node *node = &nodes[next.child];
            visits++;
            height = dpl_walk_push(node, dpl_walk_enters_node(node, axes, ray, enter), enter, stack, height);
        }
    }
    counts->node_visits += visits;
    counts->object_tests += tests;
    return ended;
}

#endif
