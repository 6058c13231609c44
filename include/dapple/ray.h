/** @file
 * Rays and what they hit: the currency of tracers. A ray and a hit are plain values, in single precision.
 */
#ifndef DAPPLE_RAY_H
#define DAPPLE_RAY_H

#include <dapple/export.h>
#include <math.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/**
 * The points origin + t * direction with near <= t <= far.
 *
 * The direction need not have length 1: `t` counts in lengths of it. A ray hits nothing when a number in it
 * is NaN, when its origin is beyond 1e9, when the largest component of its direction is not within 1e-9 ..
 * 1e9, or when near > far. A `near` below 0 counts as 0.
 */
typedef struct dpl_ray {
    float origin[3];    /**< [px] for shapes, [scene unit] for triangles; shapes ignore the third */
    float near;         /**< >= 0, in lengths of `direction` */
    float direction[3]; /**< shapes ignore the third component */
    float far;          /**< may be INFINITY */
} dpl_ray;

/** Where a ray ends. */
typedef struct dpl_hit {
    float t;        /**< in lengths of the ray's direction; INFINITY when nothing was hit */
    int32_t object; /**< number of the shape or triangle; -1 when nothing was hit */
    float u;        /**< of triangles: barycentric weight of the second corner; 0 for shapes */
    float v;        /**< of triangles: barycentric weight of the third corner; 0 for shapes */
} dpl_hit;

/** A ray from one point towards another, both ends included: far is 1. */
static inline dpl_ray dpl_ray_between(const float from[3], const float to[3]) {
    dpl_ray ray;
    for (int axis = 0; axis < 3; axis++) {
        ray.origin[axis] = from[axis];
        ray.direction[axis] = to[axis] - from[axis];
    }
    ray.near = 0.0f;
    ray.far = 1.0f;
    return ray;
}

/** The hit of a ray that hits nothing. */
static inline dpl_hit dpl_hit_none(void) {
    dpl_hit hit;
    hit.t = INFINITY;
    hit.object = -1;
    hit.u = hit.v = 0.0f;
    return hit;
}

#ifdef __cplusplus
}
#endif
#endif
