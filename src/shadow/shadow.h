/* What the methods of this room share: a light among solids, a receiver that looks at it, and the table of
 * methods. Argument checks are in src/api/shadow.c: this room trusts. */
#ifndef DPL_SHADOW_SHADOW_H
#define DPL_SHADOW_SHADOW_H

#include "shadow/horizon.h"
#include "shadow/mips.h"
#include "shadow/polar_map.h"
#include "shadow/ray_map.h"
#include "shadow/solid.h"

#include <dapple/shadow.h>

/* Counters of one worker, on cache lines of their own. */
typedef struct dpl_shadow_counts {
    int64_t pixels, lit, dark, worked, steps, fetches, map_only, field_only;
} dpl_shadow_counts;

/* One light in one world: all that a method may read. Places are the world's, not the picture's. */
typedef struct dpl_shadow_view {
    const dpl_shadow_desc *desc;
    const dpl_field *field;
    const dpl_solid *solid;
    const dpl_mips *mips;
    const dpl_horizon *horizon;
    const dpl_polar_map *map;
    const dpl_ray_map *rays;
    double position[2];
    double radius;
} dpl_shadow_view;

/* A pixel's centre outside the disc, and how it sees the light. */
typedef struct dpl_receiver {
    int32_t pixel[2];
    double x, y;     /* [px] */
    double dx, dy;   /* unit direction to the light's centre */
    double distance; /* to it [px] */
    double sine;     /* of the angle between that and the disc's rim: radius / distance, below 1 */
    double angle;    /* that angle [rad] */
} dpl_receiver;

typedef double dpl_shadow_function(const dpl_shadow_view *view, const dpl_receiver *receiver,
                                   dpl_shadow_counts *counts);

/* What a method needs before it may be called. */
enum {
    DPL_NEEDS_INSIDE = 1, /* distances inside solids, and their mips */
    DPL_NEEDS_MAP = 2,    /* the polar map */
    DPL_NEEDS_RAYS = 4    /* the ray map */
};

typedef struct dpl_shadow_ops {
    const char *name; /* as the command line spells it */
    int needs;        /* of M.R.M.A. see needs_of() in shadow.c */
    dpl_shadow_function *visibility;
} dpl_shadow_ops;

/* By method; NULL for a number that is none. */
const dpl_shadow_ops *dpl_shadow_ops_of(dpl_shadow_method method);

/* exact.c, truth.c, map_shadow.c, march.c, blend.c: V of an open pixel that is not opaque. */
dpl_shadow_function dpl_shadow_exact, dpl_shadow_truth, dpl_shadow_moments_2, dpl_shadow_moments_exponential,
    dpl_shadow_moments_4, dpl_shadow_moments_soft, dpl_shadow_pcss, dpl_shadow_hard, dpl_shadow_quilez,
    dpl_shadow_aaltonen, dpl_shadow_signed, dpl_shadow_two_sided, dpl_shadow_cones, dpl_shadow_blend;

/* exact.c: half of the irradiance of a disc of radiance 1 on a face with that normal: the integral, over what
 * is seen of the disc, of the cosine of the angle to the normal, where above 0. The radius is above 0. */
double dpl_shadow_exact_facing(const dpl_shadow_view *view, const dpl_receiver *receiver,
                               const int32_t normal[2], dpl_shadow_counts *counts);

/* blend.c: does M.R.M.A. take what the ray map says as it is? */
bool dpl_shadow_map_is_enough(const dpl_shadow_desc *desc);

/* truth.c: V and, per channel, the mean over the light's angle of what opaque pixels and media leave. */
double dpl_shadow_truth_rgb(const dpl_shadow_view *view, const dpl_receiver *receiver, double rgb[3],
                            dpl_shadow_counts *counts);

/* truth.c: what media on the way to the light's rim let through, opaque pixels ignored. */
void dpl_shadow_medium(const dpl_shadow_view *view, const dpl_receiver *receiver, double rgb[3]);

struct dpl_shadow {
    dpl_context *context;
    dpl_shadow_desc desc;
    dpl_shadow_stats stats;
    dpl_solid solid;
    dpl_mips mips;
    dpl_horizon horizon;
    dpl_polar_map map;
    dpl_ray_table rays;
    dpl_buffer result; /* float per pixel, or float[3] for light, until all has succeeded */
};

/* shadow.c: arguments are checked, strides explicit. */
DPL_MUST_CHECK dpl_status dpl_shadow_find_visibility(dpl_shadow *shadow, const dpl_field *field,
                                                     const dpl_light *light, float *visibility,
                                                     ptrdiff_t row_stride);
DPL_MUST_CHECK dpl_status dpl_shadow_find_light(dpl_shadow *shadow, const dpl_field *field,
                                                const dpl_light *lights, int32_t count,
                                                const dpl_output *output);

/* shadow.c: a receiver at a pixel; false when the pixel's centre lies inside the disc. */
bool dpl_receiver_at(const dpl_shadow_view *view, int32_t x, int32_t y, dpl_receiver *receiver);

#endif
