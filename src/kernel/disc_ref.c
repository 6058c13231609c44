/* The scalar reference of the kernel `cover`, see disc.h. */
#include "kernel/disc_ref.h"

/* What a triangle covers: points where all three sides are at least 0, and volume <= far * (sum of sides). */
typedef struct cover_sides {
    float side[3][3]; /* [edge][a, b, 1] */
    float volume;     /* six times that of the triangle and the eye, above 0 */
} cover_sides;

static float dot(const float a[3], const float b[3]) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void cross(const float a[3], const float b[3], float out[3]) {
    out[0] = a[1] * b[2] - a[2] * b[1];
    out[1] = a[2] * b[0] - a[0] * b[2];
    out[2] = a[0] * b[1] - a[1] * b[0];
}

/* False for what is seen edge on or beside the disc. */
static bool find_sides(const dpl_disc_view *view, const float *corners, cover_sides *s) {
    float corner[3][3], normal[3][3];
    for (int k = 0; k < 3; k++)
        for (int axis = 0; axis < 3; axis++)
            corner[k][axis] = corners[3 * k + axis] - view->eye[axis];
    for (int k = 0; k < 3; k++)
        cross(corner[(k + 1) % 3], corner[(k + 2) % 3], normal[k]);
    float volume = dot(corner[0], normal[0]);
    bool meets = volume < 0.0f || volume > 0.0f;
    for (int k = 0; k < 3; k++) {
        float *side = s->side[k];
        for (int i = 0; i < 3; i++) {
            float v = dot(normal[k], view->axis[i]);
            side[i] = volume < 0.0f ? -v : v;
        }
        bool beside = side[2] < 0.0f && side[2] * side[2] > side[0] * side[0] + side[1] * side[1];
        meets = meets && !beside;
    }
    s->volume = volume < 0.0f ? -volume : volume;
    return meets;
}

/* Returns whether a point is still open. */
static bool cover_points(const cover_sides *s, const dpl_disc_points *points, float far, int32_t *covered) {
    bool open = false;
    for (int32_t i = 0; i < points->count; i++) {
        float at[3];
        for (int k = 0; k < 3; k++)
            at[k] = (s->side[k][0] * points->a[i] + s->side[k][1] * points->b[i]) + s->side[k][2];
        bool behind = at[0] >= 0.0f && at[1] >= 0.0f && at[2] >= 0.0f &&
                      (at[0] + at[1] + at[2]) * far >= s->volume;
        covered[i] |= behind ? -1 : 0;
        open |= covered[i] == 0;
    }
    return open;
}

bool dpl_cover_ref(const dpl_disc_view *view, const dpl_disc_points *points,
                   const dpl_disc_triangles *triangles, int32_t count, const int32_t *slots,
                   int32_t *covered) {
    for (int32_t i = 0; i < count; i++) {
        cover_sides s;
        const float *corners = triangles->corners + (int64_t)slots[i] * triangles->stride;
        if (find_sides(view, corners, &s) && !cover_points(&s, points, view->far, covered))
            return false;
    }
    return true;
}
