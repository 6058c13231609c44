/* The kernel `cover` in vectors: first the sides of LANES triangles side by side, then, for LANES points of
 * the disc, all triangles that may cover any. Included by vector.c. Equal to disc_ref.c to the bit. */
#ifndef DPL_KERNEL_VECTOR_DISC_H
#define DPL_KERNEL_VECTOR_DISC_H

#include "kernel/disc.h"
#include "kernel/simd.h"

/* As cover_sides of disc_ref.c, for LANES triangles. */
typedef struct cover_lanes {
    vfloat side[4][3];
    vint meets;
} cover_lanes;

static inline vfloat cover_dot(const vfloat a[3], const float b[3]) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static inline void cover_cross(const vfloat a[3], const vfloat b[3], vfloat out[3]) {
    out[0] = a[1] * b[2] - a[2] * b[1];
    out[1] = a[2] * b[0] - a[0] * b[2];
    out[2] = a[0] * b[1] - a[1] * b[0];
}

static inline vint cover_is_beside(const vfloat side[3]) {
    return (side[2] < 0.0f) & (side[2] * side[2] > side[0] * side[0] + side[1] * side[1]);
}

/* Of triangles from `first` on; what is behind the last meets nothing. */
static inline void cover_find_sides(const dpl_disc_view *view, const dpl_disc_triangles *triangles,
                                    int32_t first, cover_lanes *s) {
    vfloat corner[3][3], normal[3][3];
    for (int k = 0; k < 3; k++)
        for (int axis = 0; axis < 3; axis++)
            corner[k][axis] = load_some(triangles->corner[k][axis] + first, LANES) - view->eye[axis];
    for (int k = 0; k < 3; k++)
        cover_cross(corner[(k + 1) % 3], corner[(k + 2) % 3], normal[k]);
    vfloat volume = corner[0][0] * normal[0][0] + corner[0][1] * normal[0][1] + corner[0][2] * normal[0][2];
    vint flip = triangles->exits_only ? (vint){0} : (volume < 0.0f) & INT32_MIN;
    s->meets = (volume > 0.0f) & (volume < DISC_MOST_VOLUME);
    if (!triangles->exits_only)
        s->meets |= (volume < 0.0f) & (volume > -DISC_MOST_VOLUME);
    s->meets &= lane_numbers() < triangles->count - first;
    for (int k = 0; k < 3; k++) {
        for (int n = 0; n < 3; n++)
            s->side[k][n] = (vfloat)((vint)cover_dot(normal[k], view->axis[n]) ^ flip) + 0.0f;
        s->meets &= ~cover_is_beside(s->side[k]);
    }
    for (int n = 0; n < 3 && view->ends; n++)
        s->side[3][n] = (s->side[0][n] + s->side[1][n] + s->side[2][n]) * view->far;
    if (view->ends)
        s->side[3][2] -= magnitude(volume);
}

/* Is below 0 where one of the sides is: none of them is minus 0. */
static inline vint cover_beyond(const cover_lanes *s, int lane, int sides, vfloat a, vfloat b) {
    vint beyond = {0};
    for (int k = 0; k < sides; k++)
        beyond |= (vint)((s->side[k][0][lane] * a + s->side[k][1][lane] * b) + s->side[k][2][lane]);
    return beyond;
}

/* Covers the points of two blocks, from i and from j on. `bits` say which lanes may cover something. Returns
 * which points are open. */
static inline vint cover_blocks(const cover_lanes *list, const uint32_t *bits, int32_t count, int sides,
                                const dpl_disc_points *points, int32_t i, int32_t j, int32_t *covered) {
    vfloat a0 = load_some(points->a + i, LANES), b0 = load_some(points->b + i, LANES);
    vfloat a1 = load_some(points->a + j, LANES), b1 = load_some(points->b + j, LANES);
    vint outside0 = all_int(-1), outside1 = outside0, before0, before1;
    for (int32_t k = 0; k < count; k++)
        for (uint32_t left = bits[k]; left != 0; left &= left - 1) {
            int lane = __builtin_ctz(left);
            outside0 &= cover_beyond(&list[k], lane, sides, a0, b0);
            outside1 &= cover_beyond(&list[k], lane, sides, a1, b1);
        }
    memcpy(&before0, covered + i, sizeof before0);
    memcpy(&before1, covered + j, sizeof before1);
    before0 |= outside0 >= 0;
    before1 |= outside1 >= 0;
    store_some_ints(covered + i, before0, LANES);
    store_some_ints(covered + j, before1, LANES);
    return ~before0 | ~before1;
}

static bool cover(const dpl_disc_view *view, const dpl_disc_points *points,
                  const dpl_disc_triangles *triangles, int32_t *covered) {
    cover_lanes list[DPL_DISC_TRIANGLES / LANES];
    uint32_t bits[DPL_DISC_TRIANGLES / LANES];
    int32_t count = 0;
    vint open = {0};
    for (int32_t i = 0; i < triangles->count; i += LANES) {
        cover_find_sides(view, triangles, i, &list[count]);
        bits[count] = lane_bits(list[count].meets);
        count += bits[count] != 0;
    }
    for (int32_t i = 0; i < points->count; i += 2 * LANES) {
        int32_t j = i + LANES < points->count ? i + LANES : i; /* an odd block is covered twice */
        open |= view->ends ? cover_blocks(list, bits, count, 4, points, i, j, covered)
                           : cover_blocks(list, bits, count, 3, points, i, j, covered);
    }
    return any(open);
}

#endif
