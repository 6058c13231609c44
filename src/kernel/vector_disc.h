/* The kernel `cover` in vectors: first the sides of LANES triangles side by side, then for each that may cover
 * anything all points of the disc. Included by vector.c. Equal to disc_ref.c to the bit. */
#ifndef DPL_KERNEL_VECTOR_DISC_H
#define DPL_KERNEL_VECTOR_DISC_H

#include "kernel/disc.h"
#include "kernel/simd.h"

/* As cover_sides of disc_ref.c, for LANES triangles. */
typedef struct cover_sides {
    float side[3][3][LANES];
    float volume[LANES];
    int32_t meets[LANES];
} cover_sides;

static inline vfloat cover_dot(const vfloat a[3], const float b[3]) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static inline void cover_cross(const vfloat a[3], const vfloat b[3], vfloat out[3]) {
    out[0] = a[1] * b[2] - a[2] * b[1];
    out[1] = a[2] * b[0] - a[0] * b[2];
    out[2] = a[0] * b[1] - a[1] * b[0];
}

/* Lanes from `count` on meet nothing. Returns whether any does. */
static bool cover_find_sides(const dpl_disc_view *view, const dpl_disc_triangles *triangles, int32_t count,
                             const int32_t *slots, cover_sides *s) {
    vint slot = {0}, there = lane_numbers() < count;
    memcpy(&slot, slots, (size_t)count * sizeof *slots);
    slot *= triangles->stride;
    vfloat corner[3][3], normal[3][3];
    for (int k = 0; k < 3; k++)
        for (int axis = 0; axis < 3; axis++)
            corner[k][axis] =
                gather(there, triangles->corners + 3 * k + axis, slot, all_float(0.0f)) - view->eye[axis];
    for (int k = 0; k < 3; k++)
        cover_cross(corner[(k + 1) % 3], corner[(k + 2) % 3], normal[k]);
    vfloat volume = corner[0][0] * normal[0][0] + corner[0][1] * normal[0][1] + corner[0][2] * normal[0][2];
    vint meets = there & ((volume < 0.0f) | (volume > 0.0f)), flip = (volume < 0.0f) & INT32_MIN;
    for (int k = 0; k < 3; k++) {
        vfloat side[3];
        for (int i = 0; i < 3; i++) {
            side[i] = (vfloat)((vint)cover_dot(normal[k], view->axis[i]) ^ flip);
            memcpy(s->side[k][i], &side[i], sizeof side[i]);
        }
        meets &= ~((side[2] < 0.0f) & (side[2] * side[2] > side[0] * side[0] + side[1] * side[1]));
    }
    volume = (vfloat)((vint)volume ^ flip);
    memcpy(s->volume, &volume, sizeof volume);
    memcpy(s->meets, &meets, sizeof meets);
    return any(meets);
}

/* Returns whether a point is still open. */
static bool cover_points(const cover_sides *s, int32_t lane, const dpl_disc_points *points, float far,
                         int32_t *covered) {
    vint open = {0};
    for (int32_t i = 0; i < points->count; i += LANES) {
        vfloat a = load_some(points->a + i, LANES), b = load_some(points->b + i, LANES), at[3];
        vint before;
        memcpy(&before, covered + i, sizeof before);
        for (int k = 0; k < 3; k++)
            at[k] = (s->side[k][0][lane] * a + s->side[k][1][lane] * b) + s->side[k][2][lane];
        vint behind = (at[0] >= 0.0f) & (at[1] >= 0.0f) & (at[2] >= 0.0f) &
                      ((at[0] + at[1] + at[2]) * far >= s->volume[lane]);
        before |= behind;
        open |= ~before;
        store_some_ints(covered + i, before, LANES);
    }
    return any(open);
}

static bool cover(const dpl_disc_view *view, const dpl_disc_points *points,
                  const dpl_disc_triangles *triangles, int32_t count, const int32_t *slots,
                  int32_t *covered) {
    cover_sides s;
    for (int32_t i = 0; i < count; i += LANES) {
        int32_t some = count - i < LANES ? count - i : LANES;
        if (!cover_find_sides(view, triangles, some, slots + i, &s))
            continue;
        for (int32_t lane = 0; lane < some; lane++)
            if (s.meets[lane] && !cover_points(&s, lane, points, view->far, covered))
                return false;
    }
    return true;
}

#endif
