/* The ray map of one light: shadow maps seen from many points of its disc at once. Made per light by
 * shadow.c, read by the kernel `see_rays`.
 *
 * A line that passes the light's centre at the signed distance p, in the direction c, meets a point at (r, t)
 * iff sin(t - c) = p / r. So lines of one p have a shadow map over c, and a receiver at (d, t0) finds its own
 * line of each p at c = t0 - asin(p / d): a look-up, whatever stands between. It sees the light along that
 * line iff nothing nearer to the centre lies on it. */
#ifndef DPL_SHADOW_RAY_MAP_H
#define DPL_SHADOW_RAY_MAP_H

#include "shadow/solid.h"

/* Receivers nearer than this many radii are not looked up: the angle per p grows without bound at the rim. */
#define DPL_RAY_MAP_NEAR 1.5

typedef struct dpl_ray_table {
    dpl_buffer reach;   /* float, as in dpl_ray_map */
    dpl_buffer offsets; /* float */
    dpl_ray_map map;    /* map.rays is 0 where the light has none: it is a point, or too far away */
} dpl_ray_table;

DPL_MUST_CHECK dpl_status dpl_ray_table_make(dpl_ray_table *table, dpl_context *context,
                                             const dpl_solid *solid, const double position[2], double radius,
                                             int32_t rays);

void dpl_ray_table_free(dpl_context *context, dpl_ray_table *table);

#endif
