/* The kernel `cover` in vectors: first the sides of LANES triangles side by side, then, for LANES points of
 * the disc, all triangles that may cover any. Included by vector.c. Equal to disc_ref.c to the bit. */
#ifndef DPL_KERNEL_VECTOR_DISC_H
#define DPL_KERNEL_VECTOR_DISC_H

#include "kernel/disc.h"
#include "kernel/simd.h"

/* As in disc_ref.c. */
typedef struct cover_sides {
    float side[4][3];
} cover_sides;

/* The same, for LANES triangles. */
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
    s->meets = volume > 0.0f;
    if (!triangles->exits_only)
        s->meets |= volume < 0.0f;
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

/* Writes the triangles that may cover something one behind the other; returns how many. */
static int32_t cover_list(const dpl_disc_view *view, const dpl_disc_triangles *triangles,
                          cover_sides list[DPL_DISC_TRIANGLES]) {
    int32_t count = 0;
    for (int32_t i = 0; i < triangles->count; i += LANES) {
        cover_lanes s;
        cover_find_sides(view, triangles, i, &s);
        for (uint32_t bits = lane_bits(s.meets); bits != 0; bits &= bits - 1) {
            int lane = __builtin_ctz(bits);
            for (int k = 0; k < (view->ends ? 4 : 3); k++)
                for (int n = 0; n < 3; n++)
                    list[count].side[k][n] = s.side[k][n][lane];
            count++;
        }
    }
    return count;
}

static inline vfloat cover_side_at(const float side[3], vfloat a, vfloat b) {
    return (side[0] * a + side[1] * b) + side[2];
}

static bool cover(const dpl_disc_view *view, const dpl_disc_points *points,
                  const dpl_disc_triangles *triangles, int32_t *covered) {
    cover_sides list[DPL_DISC_TRIANGLES];
    int32_t count = cover_list(view, triangles, list);
    vint open = {0};
    for (int32_t i = 0; i < points->count; i += LANES) {
        vfloat a = load_some(points->a + i, LANES), b = load_some(points->b + i, LANES);
        vint before, outside = all_int(-1); /* by the sign: no side is minus 0 */
        memcpy(&before, covered + i, sizeof before);
        for (int32_t k = 0; k < count; k++) {
            const cover_sides *s = &list[k];
            vint beyond = (vint)cover_side_at(s->side[0], a, b) | (vint)cover_side_at(s->side[1], a, b) |
                          (vint)cover_side_at(s->side[2], a, b);
            if (view->ends)
                beyond |= (vint)cover_side_at(s->side[3], a, b);
            outside &= beyond;
        }
        before |= outside >= 0;
        open |= ~before;
        store_some_ints(covered + i, before, LANES);
    }
    return any(open);
}

#endif
