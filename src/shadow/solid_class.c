/* Which receivers are surely lit or dark, from the nearest and farthest depths of the region of the map that
 * anything between them and the light can be in. Called by solid_shadow.c.
 *
 * A blocker before the receiver at depth z is within dpl_solid_disc_at(z) of the receiver's place, and the
 * map shows something at most as deep there. So the region for the nearest depth of all is enough; what is
 * nearest in that makes the region smaller, and again. */
#include "shadow/solid_shadow.h"

#include <math.h>

/* How often the region is made smaller: a receiver's own tilted surface is left behind by then. */
#define ROUNDS 4

/* Beside the region: a texel's own width, as depths are taken in texels' middles. */
#define TEXEL 1.0f

/* Depths that differ by less than this share of them are the same. */
#define SAME 1e-4f

static float region_at(const dpl_solid_receiver *r, const dpl_solid_site *site, float depth) {
    float half = depth < site->place.depth
                     ? dpl_solid_disc_at(site->map, r, site->place.depth, depth) * site->place.stretch
                     : 0.0f;
    return half + TEXEL;
}

/* Whether rays could pass between what the texels of a region show: not where they show one surface. Between
 * depths near and far a disc passes a gap as wide as the regions at the two differ. */
static bool is_one_surface(const dpl_solid_receiver *r, const dpl_solid_site *site, dpl_solid_range range) {
    return region_at(r, site, range.near) - region_at(r, site, range.far) < 2.0f * TEXEL;
}

void dpl_solid_classify(const dpl_solid_receiver *r, dpl_solid_site *site) {
    float depth = site->place.depth, nearest = site->map->frame.near, half = 0.0f;
    dpl_solid_range range = {nearest, nearest};
    site->slope = dpl_solid_slope(site->map, r);
    site->class = DPL_SOLID_PENUMBRA;
    for (int i = 0; i < ROUNDS; i++) {
        half = region_at(r, site, nearest);
        range = dpl_solid_range_around(site->map, &site->place, half);
        float bias = site->slope * (half + TEXEL) * (half < 3.0f * TEXEL ? 1.0f : 0.0f) + SAME * depth;
        if (range.near >= depth - bias) {
            site->class = DPL_SOLID_LIT;
            break;
        }
        if (i > 0 && range.near <= nearest)
            break;
        nearest = range.near;
    }
    site->range = range;
    if (site->class == DPL_SOLID_PENUMBRA &&
        range.far < depth - SAME * depth - site->slope * (half + TEXEL) && is_one_surface(r, site, range))
        site->class = DPL_SOLID_DARK;
}
