/* Prepares a ray for walk.h. Called once per ray by triangle.c and shape.c. */
#include "bvh/walk.h"

#include <float.h>
#include <math.h>

#define FARTHEST_ORIGIN 1e9f
#define SHORTEST_DIRECTION 1e-9f
#define LONGEST_DIRECTION 1e9f

/* Stands for 1 / 0: finite, so that 0 times it is 0 and not NaN. */
#define INVERSE_OF_NOTHING 1e37f

/* 1 + 2 gamma(3), rounded up, and one rounding more for the product with it. */
#define A_LITTLE_MORE 1.0000006f

bool dpl_walk_ray_prepare(const dpl_ray *ray, int32_t axes, dpl_walk_ray *prepared) {
    float longest = 0.0f;
    bool good = ray->near <= ray->far;
    for (int32_t axis = 0; axis < axes; axis++) {
        float direction = ray->direction[axis], size = fabsf(direction);
        good &= fabsf(ray->origin[axis]) <= FARTHEST_ORIGIN && size <= LONGEST_DIRECTION;
        longest = size > longest ? size : longest;
        prepared->origin[axis] = ray->origin[axis];
        prepared->inverse[axis] =
            size < 1.0f / INVERSE_OF_NOTHING ? copysignf(INVERSE_OF_NOTHING, direction) : 1.0f / direction;
        prepared->to_far[axis] = prepared->inverse[axis] * A_LITTLE_MORE;
        prepared->behind[axis] = prepared->inverse[axis] < 0.0f;
    }
    prepared->near = ray->near > 0.0f ? ray->near : 0.0f;
    prepared->far = ray->far < FLT_MAX ? ray->far : FLT_MAX;
    return good && longest >= SHORTEST_DIRECTION && prepared->near <= prepared->far;
}
