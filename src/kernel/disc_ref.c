/* The scalar reference of the kernel `cover`, see disc.h. */
#include "kernel/disc_ref.h"

/* What a triangle covers: points where all its sides are at least 0. The last is the end of the way. */
typedef struct cover_sides {
    float side[4][3]; /* [edge][a, b, 1] */
} cover_sides;

static float dot(const float a[3], const float b[3]) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void cross(const float a[3], const float b[3], float out[3]) {
    out[0] = a[1] * b[2] - a[2] * b[1];
    out[1] = a[2] * b[0] - a[0] * b[2];
    out[2] = a[0] * b[1] - a[1] * b[0];
}

/* No point of the disc is on the positive side. */
static bool is_beside(const float side[3]) {
    return side[2] < 0.0f && side[2] * side[2] > side[0] * side[0] + side[1] * side[1];
}

/* False for what faces the wrong way, is seen edge on, or beside the disc. */
static bool find_sides(const dpl_disc_view *view, const dpl_disc_triangles *triangles, int32_t i,
                       cover_sides *s) {
    float corner[3][3], normal[3][3];
    for (int k = 0; k < 3; k++)
        for (int axis = 0; axis < 3; axis++)
            corner[k][axis] = triangles->corner[k][axis][i] - view->eye[axis];
    for (int k = 0; k < 3; k++)
        cross(corner[(k + 1) % 3], corner[(k + 2) % 3], normal[k]);
    float volume = dot(corner[0], normal[0]);
    bool meets = (volume > 0.0f && volume < DISC_MOST_VOLUME) ||
                 (volume < 0.0f && volume > -DISC_MOST_VOLUME && !triangles->exits_only);
    for (int k = 0; k < 3; k++) {
        for (int n = 0; n < 3; n++) {
            float v = dot(normal[k], view->axis[n]);
            s->side[k][n] = (volume < 0.0f ? -v : v) + 0.0f; /* never minus 0 */
        }
        meets = meets && !is_beside(s->side[k]);
    }
    for (int n = 0; n < 3; n++)
        s->side[3][n] = (s->side[0][n] + s->side[1][n] + s->side[2][n]) * view->far;
    s->side[3][2] -= volume < 0.0f ? -volume : volume;
    return meets;
}

static bool covers(const cover_sides *s, int32_t sides, float a, float b) {
    bool inside = true;
    for (int32_t k = 0; k < sides; k++)
        inside = inside && (s->side[k][0] * a + s->side[k][1] * b) + s->side[k][2] >= 0.0f;
    return inside;
}

bool dpl_cover_ref(const dpl_disc_view *view, const dpl_disc_points *points,
                   const dpl_disc_triangles *triangles, int32_t *covered) {
    bool open = false;
    for (int32_t i = 0; i < triangles->count; i++) {
        cover_sides s;
        if (!find_sides(view, triangles, i, &s))
            continue;
        for (int32_t k = 0; k < points->count; k++)
            covered[k] |= covers(&s, view->ends ? 4 : 3, points->a[k], points->b[k]) ? -1 : 0;
    }
    for (int32_t k = 0; k < points->count; k++)
        open |= covered[k] == 0;
    return open;
}
