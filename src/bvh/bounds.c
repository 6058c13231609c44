/* Boxes. Called by build.c, refit.c and by whoever makes boxes of objects. */
#include "bvh/bvh.h"

#include <math.h>

dpl_bounds dpl_bounds_empty(void) {
    return (dpl_bounds){{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}};
}

static inline float least(float a, float b) {
    return a < b ? a : b;
}

static inline float greatest(float a, float b) {
    return a > b ? a : b;
}

void dpl_bounds_add_point(dpl_bounds *bounds, const float point[3]) {
    for (int axis = 0; axis < 3; axis++) {
        bounds->low[axis] = least(bounds->low[axis], point[axis]);
        bounds->high[axis] = greatest(bounds->high[axis], point[axis]);
    }
}

void dpl_bounds_add(dpl_bounds *bounds, const dpl_bounds *other) {
    for (int axis = 0; axis < 3; axis++) {
        bounds->low[axis] = least(bounds->low[axis], other->low[axis]);
        bounds->high[axis] = greatest(bounds->high[axis], other->high[axis]);
    }
}

float dpl_bounds_half_area(const dpl_bounds *b, int32_t axes) {
    float x = b->high[0] - b->low[0], y = b->high[1] - b->low[1], z = b->high[2] - b->low[2];
    if (!(x >= 0.0f))
        return 0.0f;
    return axes == 2 ? x + y : x * y + y * z + z * x;
}

void dpl_bounds_pad(dpl_bounds *bounds, int32_t axes) {
    for (int32_t axis = 0; axis < axes; axis++) {
        bounds->low[axis] -= fabsf(bounds->low[axis]) * 1.2e-7f + 1e-20f;
        bounds->high[axis] += fabsf(bounds->high[axis]) * 1.2e-7f + 1e-20f;
    }
}
