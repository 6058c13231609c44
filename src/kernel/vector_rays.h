/* Straight rays in vectors, as ref.c sets them up. Included by vector_march.h and vector_sweep.h. */
#ifndef DPL_KERNEL_VECTOR_RAYS_H
#define DPL_KERNEL_VECTOR_RAYS_H

#include "kernel/kernel.h"
#include "kernel/lanes.h"
#include "kernel/march.h"

typedef struct rays {
    vfloat x, y;
    vfloat dx, dy;
    vfloat length;
} rays;

static inline vfloat inverse_or_never(vfloat d) {
    return choose(lanes_equal(d, all_float(0.0f)), all_float(NEVER), 1.0f / d);
}

static inline rays rays_from_to(vfloat x0, vfloat y0, vfloat x1, vfloat y1) {
    rays r = {.x = x0, .y = y0};
    vfloat dx = x1 - x0, dy = y1 - y0;
    r.length = square_root(dx * dx + dy * dy);
    vfloat scale = inverse_or_never(r.length);
    r.dx = dx * scale;
    r.dy = dy * scale;
    return r;
}

static inline rays rays_between(const dpl_segments *segments, int32_t first, int32_t count) {
    return rays_from_to(load_some(segments->x0 + first, count), load_some(segments->y0 + first, count),
                        load_some(segments->x1 + first, count), load_some(segments->y1 + first, count));
}

static inline vint clamp_ints(vint v, int32_t high) {
    v = select_int(v < 0, all_int(0), v);
    return select_int(v > high, all_int(high), v);
}

/* What the rays have gathered so far. */
typedef struct gathered {
    vfloat radiance[3];
    vfloat passed[3];
} gathered;

#endif
