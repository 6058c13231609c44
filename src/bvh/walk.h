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

#include <dapple/ray.h>

/* What was done, summed over rays. */
typedef struct dpl_walk_counts {
    int64_t object_tests; /* shapes or triangles that were asked */
    int64_t node_visits;  /* nodes of the hierarchy, two boxes each */
} dpl_walk_counts;

/* A ray as boxes want it. */
typedef struct dpl_walk_ray {
    float origin[3];
    float inverse[3];  /* of the direction; never 0 or infinite */
    int32_t behind[3]; /* 1 where the direction is negative: the high plane comes first */
    float near;
    float far; /* finite; the nearest hit so far */
} dpl_walk_ray;

/* False for a ray that hits nothing, as dpl_ray says. */
bool dpl_walk_ray_prepare(const dpl_ray *ray, int32_t axes, dpl_walk_ray *prepared);

/* 1 + 2 gamma(3) in single precision, rounded up, and one rounding for the product with it. */
#define DPL_WALK_FAR 1.0000005f

/* Where the ray enters the box given by planes[axis][low, high], `stride` floats apart; false when it does
 * not between near and far. */
static inline bool dpl_walk_enters(const float *planes, int32_t stride, int32_t axes, const dpl_walk_ray *ray,
                                   float *enter) {
    float in = ray->near, out = ray->far;
    for (int32_t axis = 0; axis < axes; axis++) {
        const float *pair = planes + 2 * stride * axis;
        int32_t behind = ray->behind[axis];
        float first = (pair[stride * behind] - ray->origin[axis]) * ray->inverse[axis];
        float second = (pair[stride * (1 - behind)] - ray->origin[axis]) * ray->inverse[axis];
        second *= DPL_WALK_FAR;
        in = first > in ? first : in;
        out = second < out ? second : out;
    }
    *enter = in;
    return in <= out;
}

/* As above, for a box outside of any node. */
static inline bool dpl_walk_enters_bounds(const dpl_bounds *bounds, int32_t axes, const dpl_walk_ray *ray,
                                          float *enter) {
    float planes[6];
    for (int32_t axis = 0; axis < axes; axis++) {
        planes[2 * axis] = bounds->low[axis];
        planes[2 * axis + 1] = bounds->high[axis];
    }
    return dpl_walk_enters(planes, 1, axes, ray, enter);
}

/* Asks the object in a slot, whose box the ray enters at `enter`. May shorten ray->far to what it hits.
 * Returns true to end the walk. */
typedef bool dpl_walk_ask(void *asker, int32_t slot, float enter, dpl_walk_ray *ray);

/* Asks every object in turn, where its box is entered: what a walk replaces. */
static inline bool dpl_walk_all(const dpl_bounds *bounds, int32_t count, int32_t axes, dpl_walk_ray *ray,
                                dpl_walk_ask *ask, void *asker, dpl_walk_counts *counts) {
    float enter;
    for (int32_t i = 0; i < count; i++)
        if (dpl_walk_enters_bounds(&bounds[i], axes, ray, &enter) && ask(asker, i, enter, ray)) {
            counts->object_tests += i + 1;
            return true;
        }
    counts->object_tests += count;
    return false;
}

/* Walks. Inlined, with `axes` and `ask` known, into each of its few callers. */
static inline bool dpl_walk(const dpl_bvh *bvh, int32_t axes, dpl_walk_ray *ray, dpl_walk_ask *ask,
                            void *asker, dpl_walk_counts *counts) {
    struct {
        int32_t child;
        float enter;
    } stack[DPL_BVH_MAX_DEPTH];
    const dpl_bvh_node *nodes = bvh->nodes.data;
    int32_t height = 0, child = 0;
    int64_t visits = 0, tests = 0;
    bool ended = false;
    float enter = ray->near;
    if (bvh->node_count == 0)
        return false;
    for (;;) {
        if (child < 0) {
            tests++;
            ended = ask(asker, ~child, enter, ray);
            if (ended)
                break;
        } else {
            const dpl_bvh_node *node = &nodes[child];
            float enters[2];
            visits++;
            bool left = dpl_walk_enters(&node->planes[0][0][0], 2, axes, ray, &enters[0]);
            bool right = dpl_walk_enters(&node->planes[0][0][1], 2, axes, ray, &enters[1]);
            if (left & right) {
                int32_t nearer = enters[1] < enters[0];
                stack[height].child = node->child[1 - nearer];
                stack[height++].enter = enters[1 - nearer];
                child = node->child[nearer];
                enter = enters[nearer];
                continue;
            }
            if (left | right) {
                child = node->child[right];
                enter = enters[right];
                continue;
            }
        }
        do {
            if (height == 0)
                goto done;
            child = stack[--height].child;
            enter = stack[height].enter;
        } while (enter > ray->far);
    }
done:
    counts->node_visits += visits;
    counts->object_tests += tests;
    return ended;
}

#endif
