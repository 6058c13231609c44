/* The polar map of one light: per direction the distance to the first opaque pixel, prepared so that any
 * window of directions is summed up by its moments and its nearest distance in a fixed number of reads. Made
 * per light by shadow.c, read by map_shadow.c.
 *
 * Texels are equal stretches of the outline of a square (polar.h), stored twice around so that no window
 * wraps. Depths are distances scaled to -1 .. 1. */
#ifndef DPL_SHADOW_POLAR_MAP_H
#define DPL_SHADOW_POLAR_MAP_H

#include "shadow/moment_table.h"
#include "shadow/solid.h"

typedef struct dpl_polar_map {
    int32_t texels;         /* once around */
    double reach;           /* distance that becomes depth 1: nothing in the picture is further [px] */
    dpl_buffer distances;   /* float per texel, twice around: first hit, `reach` where there is none [px] */
    dpl_buffer nearest;     /* level k, float per texel, twice around: least of 2^k texels from this on */
    dpl_buffer warped_sums; /* double[4]: sums of dpl_moments_warp() before each texel; only if asked for */
    dpl_buffer table_sums;
    dpl_moment_table table;
} dpl_polar_map;

/* A window of texels, fractions included: 0 <= from < texels, from < to <= 2 texels. */
typedef struct dpl_polar_window {
    double from, to;
} dpl_polar_window;

/* Sharpness of the exponential warp. */
#define DPL_POLAR_SHARPNESS 5.54

/* `with_warps`: fill warped_sums too. */
DPL_MUST_CHECK dpl_status dpl_polar_map_make(dpl_polar_map *map, dpl_context *context, const dpl_solid *solid,
                                             const double position[2], int32_t texels, bool with_warps);

void dpl_polar_map_free(dpl_context *context, dpl_polar_map *map);

/* All directions within `half` [rad, at most pi/2] of (dx, dy), at least one texel. */
dpl_polar_window dpl_polar_window_around(const dpl_polar_map *map, double dx, double dy, double half);

static inline double dpl_polar_depth(const dpl_polar_map *map, double distance) {
    return 2.0 * distance / map->reach - 1.0;
}

static inline double dpl_polar_distance(const dpl_polar_map *map, double depth) {
    return 0.5 * (depth + 1.0) * map->reach;
}

/* Least distance of any texel that a window touches. */
double dpl_polar_nearest(const dpl_polar_map *map, dpl_polar_window window);

/* Mean moments over a window, biased for 32-bit sums; and mean warped moments. */
void dpl_polar_moments(const dpl_polar_map *map, dpl_polar_window window, double b[4]);
void dpl_polar_warped(const dpl_polar_map *map, dpl_polar_window window, double warped[4]);

#endif
