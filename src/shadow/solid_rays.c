/* Visibility by rays, one by one, to points spread evenly over the light's disc: the truth. Called by
 * solid_shadow.c. */
#include "shadow/solid_shadow.h"

#include <math.h>

void dpl_solid_point_of_disc(int32_t i, int32_t count, float *a, float *b) {
    static const float GOLDEN_ANGLE = 2.39996323f;
    float radius = sqrtf(((float)i + 0.5f) / (float)count), angle = GOLDEN_ANGLE * (float)i;
    *a = radius * cosf(angle);
    *b = radius * sinf(angle);
}

double dpl_solid_by_rays(const dpl_solid_shadow *shadow, const dpl_solid_receiver *r, int32_t rays,
                         dpl_walk_counts *counts) {
    dpl_ray ray = {.far = DPL_SOLID_BEFORE_LIGHT * r->distance};
    int32_t open = 0;
    bool has_normal = dpl_solid_dot(r->normal, r->normal) > 0.0f;
    for (int axis = 0; axis < 3; axis++)
        ray.origin[axis] = r->position[axis] + shadow->surface_offset * r->normal[axis];
    for (int32_t i = 0; i < rays; i++) {
        float a, b;
        dpl_solid_point_of_disc(i, rays, &a, &b);
        for (int axis = 0; axis < 3; axis++)
            ray.direction[axis] = r->toward[axis] + r->spread * (a * r->right[axis] + b * r->up[axis]);
        if (has_normal && dpl_solid_dot(r->normal, ray.direction) <= 0.0f)
            continue;
        open += !dpl_triangles_occluded(&shadow->mesh->triangles, &ray, counts);
    }
    return (double)open / rays;
}
