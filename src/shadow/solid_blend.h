/* The weight of the map term beside the march, in space. The flat side of this room has rules of its own in
 * blend.h; these three are the ones that make sense here and mean the same. Used by solid_shadow.c. */
#ifndef DPL_SHADOW_SOLID_BLEND_H
#define DPL_SHADOW_SOLID_BLEND_H

#include "shadow/blend.h"

#include <dapple/solid_shadow.h>

/* a V_map + (1 - a) V_march. Both are nearly upper bounds, so the lower one is the better; the smooth minimum
 * hides the kink between them. */
static inline double dpl_solid_blend(const dpl_solid_shadow_desc *desc, double map, double march) {
    double a = (double)desc->constant;
    if (desc->weight == DPL_SOLID_WEIGHT_MIN)
        a = map < march ? 1.0 : 0.0;
    if (desc->weight == DPL_SOLID_WEIGHT_SMOOTH_MIN)
        a = dpl_blend_smooth_minimum(map, march, (double)desc->tau);
    return a * map + (1.0 - a) * march;
}

#endif
