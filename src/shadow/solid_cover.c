/* Visibility by a few rays at once: one walk finds the triangles that any ray to the light's disc can meet,
 * and a kernel says which points of the disc they cover. Called by solid_shadow.c for refinement; the truth
 * follows its rays one by one (solid_rays.c). */
#include "shadow/solid_shadow.h"

#include "bvh/shaft.h"

#include <float.h>
#include <math.h>

/* The directions of a shaft are taken this much wider: of rounding. */
#define WIDER 1e-5f

void dpl_solid_points_spread(dpl_disc_points *points, int32_t rays) {
    *points = (dpl_disc_points){.count = (rays + DPL_DISC_BLOCK - 1) / DPL_DISC_BLOCK * DPL_DISC_BLOCK};
    for (int32_t i = 0; i < rays; i++)
        dpl_solid_point_of_disc(i, rays, &points->a[i], &points->b[i]);
}

/* One receiver's points, and what covers them. */
typedef struct sight {
    const dpl_kernels *kernels;
    const dpl_disc_points *points;
    dpl_disc_triangles triangles;
    dpl_disc_view view;
    int32_t covered[DPL_DISC_MOST];
} sight;

static dpl_disc_view view_of(const dpl_solid_shadow *shadow, const dpl_solid_receiver *r) {
    dpl_disc_view view = {.far = fminf(DPL_SOLID_BEFORE_LIGHT * r->distance, FLT_MAX)};
    for (int axis = 0; axis < 3; axis++) {
        view.eye[axis] = r->position[axis] + shadow->surface_offset * r->normal[axis];
        view.axis[0][axis] = r->spread * r->right[axis];
        view.axis[1][axis] = r->spread * r->up[axis];
        view.axis[2][axis] = r->toward[axis];
    }
    return view;
}

/* The directions from the middle of the disc to its rim, along each axis of the world. */
static dpl_shaft shaft_of(const dpl_disc_view *view) {
    dpl_shaft shaft = {.far = view->far};
    for (int axis = 0; axis < 3; axis++) {
        float a = view->axis[0][axis], b = view->axis[1][axis], middle = view->axis[2][axis];
        float reach = sqrtf(a * a + b * b) * (1.0f + WIDER) + WIDER * fabsf(middle);
        shaft.origin[axis] = view->eye[axis];
        shaft.least[axis] = middle - reach;
        shaft.most[axis] = middle + reach;
    }
    return shaft;
}

/* Points behind the receiver's horizon are covered, as are those that only fill up the last block. */
static void cover_horizon(sight *s, const dpl_solid_receiver *r, int32_t rays) {
    float side[3];
    bool has_normal = dpl_solid_dot(r->normal, r->normal) > 0.0f;
    for (int i = 0; i < 3; i++)
        side[i] = dpl_solid_dot(r->normal, s->view.axis[i]);
    for (int32_t i = 0; i < s->points->count; i++) {
        float height = side[2] + (side[0] * s->points->a[i] + side[1] * s->points->b[i]);
        s->covered[i] = i >= rays || (has_normal && height <= 0.0f) ? -1 : 0;
    }
}

static bool cover(void *visitor, const int32_t *slots, int32_t count) {
    sight *s = visitor;
    return !s->kernels->cover(&s->view, s->points, &s->triangles, count, slots, s->covered);
}

double dpl_solid_by_cover(const dpl_solid_shadow *shadow, const dpl_solid_receiver *r,
                          dpl_walk_counts *counts) {
    const dpl_triangles *set = &shadow->mesh->triangles;
    const dpl_triangle *packed = set->packed.data;
    int32_t rays = shadow->desc.refine_rays, open = 0;
    sight s = {.kernels = shadow->context->kernels, .points = &shadow->points};
    s.triangles = (dpl_disc_triangles){packed->corner[0], (int32_t)(sizeof *packed / sizeof(float))};
    s.view = view_of(shadow, r);
    cover_horizon(&s, r, rays);
    dpl_shaft shaft = shaft_of(&s.view);
    dpl_shaft_walk(set, &shaft, cover, &s, counts);
    for (int32_t i = 0; i < rays; i++)
        open += s.covered[i] == 0;
    return (double)open / rays;
}
