/* Visibility by the map: moments of the region that blockers can be in say how deep they are, that says how
 * wide the penumbra is, and moments of a box as wide say how much of it is blocked. Called by
 * solid_shadow.c.
 *
 * Source: Peters et al. 2017, "Improved moment shadow maps", moment soft shadow mapping. */
#include "shadow/moments.h"
#include "shadow/solid_shadow.h"

#include <math.h>

/* A box whose half side is this share of a disc's radius spreads an edge as far as the disc does. */
#define BOX_OF_DISC 0.886f

/* Smallest box: half a side [texel]. */
#define LEAST_HALF 0.75f

/* Texels are rounded down when they are summed up, each by less than a step of the table. With no more bias
 * than that, two depths alone are no longer possible moments; and never less than LEAST_BIAS. */
#define BIAS_STEPS 3.0
#define LEAST_BIAS 1e-5

/* Share of blockers from which on nothing is left to be lit. */
#define ALL 0.995

/* Mean moments of a square; what is beyond the map is as far as nothing. */
static bool mean_of(const dpl_solid_map *map, const dpl_solid_place *place, float half, double b[4]) {
    double size = map->size, most = 0.5 * (map->size / 8);
    double h = (double)half < LEAST_HALF ? (double)LEAST_HALF : (double)half < most ? (double)half : most;
    double u0 = fmax((double)place->u - h, 0.0), u1 = fmin((double)place->u + h, size);
    double v0 = fmax((double)place->v - h, 0.0), v1 = fmin((double)place->v + h, size);
    if (!(u1 - u0 > 1e-3 && v1 - v0 > 1e-3))
        return false;
    dpl_moment_table_mean(&map->table, u0, v0, u1, v1, b);
    double share = (u1 - u0) * (v1 - v0) / (4.0 * h * h);
    for (int i = 0; i < 4; i++)
        b[i] = share * b[i] + 1.0 - share;
    double bias = fmax(BIAS_STEPS * dpl_moment_table_step(&map->table), LEAST_BIAS);
    dpl_moments_add_bias(b, bias, DPL_MOMENTS_TARGET_FLOAT);
    return true;
}

static double normalised(const dpl_solid_frame *frame, float depth) {
    double z = 2.0 * ((double)depth - (double)frame->near) / ((double)frame->far - (double)frame->near) - 1.0;
    return z < 1.0 ? z : 1.0;
}

double dpl_solid_by_moments(const dpl_solid_receiver *r, const dpl_solid_site *site) {
    const dpl_solid_map *map = site->map;
    const dpl_solid_frame *frame = &map->frame;
    float depth = site->place.depth, widen = sqrtf(site->place.stretch);
    if (!(site->near < depth))
        return 1.0;
    double b[4], share;
    float search = dpl_solid_disc_at(map, r, depth, site->near) * widen;
    if (!mean_of(map, &site->place, search, b))
        return 1.0;
    double blocker = dpl_moments_blocker(b, normalised(frame, depth), &share);
    if (share > ALL)
        return 0.0;
    float at = frame->near + (float)(0.5 * (blocker + 1.0)) * (frame->far - frame->near);
    at = fminf(fmaxf(at, site->near), depth);
    float half = dpl_solid_disc_at(map, r, depth, at) * widen * BOX_OF_DISC;
    float bias = site->slope * fmaxf(half, LEAST_HALF);
    if (!mean_of(map, &site->place, half, b))
        return 1.0;
    return dpl_moments_visibility(b, normalised(frame, depth - bias));
}
