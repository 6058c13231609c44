/* The horizon around one light: per direction, up to which distance a receiver is surely lit, and between
 * which distances it is surely dark. One division and one look sort most pixels; a method works on the rest.
 * Made per light by shadow.c.
 *
 * In the coordinates (angle t seen from the light's centre, a = asin(R / r)) what lies between a receiver
 * (t0, a0) and the disc is the exact triangle |t - t0| <= a - a0. So the receiver sees the whole disc iff no
 * opaque point (t, a) has a - |t - t0| > a0: iff a0 is above the upper envelope of one tent per point. And it
 * sees nothing if a connected stretch of what the light's centre sees crosses the whole triangle. Both turn
 * into thresholds of the distance. They are proven with a margin: they may leave pixels open, never lie. */
#ifndef DPL_SHADOW_HORIZON_H
#define DPL_SHADOW_HORIZON_H

#include "shadow/polar.h"
#include "shadow/solid.h"

typedef enum dpl_shadow_class { DPL_SHADOW_LIT, DPL_SHADOW_DARK, DPL_SHADOW_OPEN } dpl_shadow_class;

/* Of one bin, squared [px^2]: three floats, as in dpl_horizon_table. */
typedef struct dpl_horizon_bin {
    float lit_to;    /* lit up to here */
    float dark_from; /* dark beyond here … */
    float dark_to;   /* … up to here */
} dpl_horizon_bin;

typedef struct dpl_horizon {
    int32_t bin_count; /* a power of two */
    dpl_buffer bins;   /* dpl_horizon_bin */
    dpl_buffer angles; /* double: angle of each bin's middle, then of each bin's beginning and the last end,
                          one unused, then the middles' unit directions */
    dpl_buffer work;   /* of dpl_horizon_make() */
    double position[2];
} dpl_horizon;

DPL_MUST_CHECK dpl_status dpl_horizon_make(dpl_horizon *horizon, dpl_context *context, const dpl_solid *solid,
                                           const double position[2], double radius);

void dpl_horizon_free(dpl_context *context, dpl_horizon *horizon);

/* As the kernel `look_round` reads it. */
static inline dpl_horizon_table dpl_horizon_table_of(const dpl_horizon *horizon) {
    return (dpl_horizon_table){(const float(*)[3])horizon->bins.data, horizon->bin_count};
}

#endif
