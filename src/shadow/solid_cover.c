/* Visibility by a few rays at once: for some neighbouring receivers one walk finds the triangles that any of
 * their rays to the light's disc can meet, and a kernel says which points of each disc they cover. Called by
 * solid_shadow.c for refinement; the truth follows its rays one by one (solid_rays.c). */
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

/* What one receiver sees of the disc. */
typedef struct sight {
    dpl_disc_view view;
    bool open; /* not all of it is covered */
    int32_t covered[DPL_DISC_MOST];
} sight;

typedef struct group {
    const dpl_solid_shadow *shadow;
    int32_t count;
    sight sights[DPL_SOLID_GROUP];
} group;

static dpl_disc_view view_of(const dpl_solid_shadow *shadow, const dpl_solid_receiver *r) {
    const dpl_mesh_facts *facts = &shadow->mesh->facts;
    float farthest = 0.0f;
    dpl_disc_view view = {.far = fminf(DPL_SOLID_BEFORE_LIGHT * r->distance, FLT_MAX)};
    for (int axis = 0; axis < 3; axis++) {
        view.eye[axis] = r->position[axis] + shadow->surface_offset * r->normal[axis];
        view.axis[0][axis] = r->spread * r->right[axis];
        view.axis[1][axis] = r->spread * r->up[axis];
        view.axis[2][axis] = r->toward[axis];
        /* the corner of the mesh's box that is farthest along the way */
        farthest +=
            r->toward[axis] * ((r->toward[axis] > 0.0f ? facts->high : facts->low)[axis] - view.eye[axis]);
    }
    view.ends = farthest >= view.far * (1.0f - WIDER);
    return view;
}

/* Points behind the receiver's horizon are covered, as are those that only fill up the last block. */
static void cover_horizon(sight *s, const dpl_solid_receiver *r, const dpl_disc_points *points,
                          int32_t rays) {
    float side[3];
    for (int i = 0; i < 3; i++)
        side[i] = dpl_solid_dot(r->normal, s->view.axis[i]);
    s->open = true;
    for (int32_t i = 0; i < points->count; i++)
        s->covered[i] = i < rays ? 0 : -1;
    if (side[2] >= r->spread || !(dpl_solid_dot(r->normal, r->normal) > 0.0f))
        return;
    for (int32_t i = 0; i < rays; i++)
        s->covered[i] = side[2] + (side[0] * points->a[i] + side[1] * points->b[i]) <= 0.0f ? -1 : 0;
}

/* Makes a shaft wide enough for all lines from an eye to the disc. */
static void widen(dpl_shaft *shaft, const dpl_disc_view *view) {
    shaft->far = fmaxf(shaft->far, view->far);
    for (int axis = 0; axis < 3; axis++) {
        float a = view->axis[0][axis], b = view->axis[1][axis], middle = view->axis[2][axis];
        float reach = sqrtf(a * a + b * b) * (1.0f + WIDER) + WIDER * fabsf(middle);
        shaft->low[axis] = fminf(shaft->low[axis], view->eye[axis]);
        shaft->high[axis] = fmaxf(shaft->high[axis], view->eye[axis]);
        shaft->least[axis] = fminf(shaft->least[axis], middle - reach);
        shaft->most[axis] = fmaxf(shaft->most[axis], middle + reach);
    }
}

/* Lanes of the last vector that stay empty are filled up with the last triangle. */
static void gather(dpl_disc_triangles *triangles, const dpl_triangle *packed, const int32_t *slots,
                   int32_t count) {
    triangles->count = count;
    for (int32_t i = 0; i < (count + DPL_DISC_BLOCK - 1) / DPL_DISC_BLOCK * DPL_DISC_BLOCK; i++) {
        const dpl_triangle *t = &packed[slots[i < count ? i : count - 1]];
        for (int k = 0; k < 3; k++)
            for (int axis = 0; axis < 3; axis++)
                triangles->corner[k][axis][i] = t->corner[k][axis];
    }
}

static bool cover(void *visitor, const int32_t *slots, int32_t count) {
    group *g = visitor;
    const dpl_solid_shadow *shadow = g->shadow;
    const dpl_triangle *packed = shadow->mesh->triangles.packed.data;
    dpl_disc_triangles triangles;
    bool open = false;
    triangles.exits_only = shadow->exits_only;
    gather(&triangles, packed, slots, count);
    for (int32_t i = 0; i < g->count; i++) {
        sight *s = &g->sights[i];
        if (s->open)
            s->open = shadow->context->kernels->cover(&s->view, &shadow->points, &triangles, s->covered);
        open |= s->open;
    }
    return !open;
}

void dpl_solid_by_cover(const dpl_solid_shadow *shadow, const dpl_solid_receiver *receivers, int32_t count,
                        double *visibility, dpl_walk_counts *counts) {
    int32_t rays = shadow->desc.refine_rays;
    group g;
    g.shadow = shadow;
    g.count = count;
    dpl_shaft shaft = {.low = {INFINITY, INFINITY, INFINITY},
                       .high = {-INFINITY, -INFINITY, -INFINITY},
                       .least = {INFINITY, INFINITY, INFINITY},
                       .most = {-INFINITY, -INFINITY, -INFINITY}};
    for (int32_t i = 0; i < count; i++) {
        g.sights[i].view = view_of(shadow, &receivers[i]);
        cover_horizon(&g.sights[i], &receivers[i], &shadow->points, rays);
        widen(&shaft, &g.sights[i].view);
    }
    dpl_shaft_walk(&shadow->mesh->triangles, &shaft, cover, &g, counts);
    for (int32_t i = 0; i < count; i++) {
        int32_t open = 0;
        for (int32_t k = 0; k < rays; k++)
            open += g.sights[i].covered[k] == 0;
        visibility[i] = (double)open / rays;
    }
}
