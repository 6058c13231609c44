/* Shadows from the polar map: moments in one kernel, moments with a blocker search, and PCSS. */
#include "shadow/map_shadow.h"

#include "shadow/coverage.h"
#include "shadow/moments.h"

#include <math.h>

#define DEFAULT_TAPS 32
/* Times that the search's window shrinks to what its nearest blocker allows. */
#define SEARCH_ROUNDS 4

/* ---- one kernel ----------------------------------------------------------------------------------- */

/* As wide as the penumbra of a blocker half way between the disc and the receiver: the light's size decides,
 * not a constant. */
static dpl_polar_window one_kernel(const dpl_shadow_view *view, const dpl_receiver *r) {
    double half = dpl_penumbra_half_angle(view->radius, 0.5 * (view->radius + r->distance), r->distance);
    return dpl_polar_window_around(view->map, -r->dx, -r->dy, half);
}

double dpl_shadow_moments_2(const dpl_shadow_view *view, const dpl_receiver *r, dpl_shadow_counts *counts) {
    double b[4];
    counts->fetches += 2;
    dpl_polar_moments(view->map, one_kernel(view, r), b);
    return dpl_moments_cantelli(b[0], b[1], dpl_polar_depth(view->map, r->distance),
                                DPL_MOMENTS_LEAST_VARIANCE);
}

double dpl_shadow_moments_exponential(const dpl_shadow_view *view, const dpl_receiver *r,
                                      dpl_shadow_counts *counts) {
    double warped[4];
    counts->fetches += 2;
    dpl_polar_warped(view->map, one_kernel(view, r), warped);
    return dpl_moments_warped_visibility(warped, dpl_polar_depth(view->map, r->distance), DPL_POLAR_SHARPNESS,
                                         sqrt(DPL_MOMENTS_LEAST_VARIANCE));
}

double dpl_shadow_moments_4(const dpl_shadow_view *view, const dpl_receiver *r, dpl_shadow_counts *counts) {
    double b[4];
    counts->fetches += 2;
    dpl_polar_moments(view->map, one_kernel(view, r), b);
    return dpl_moments_visibility(b, dpl_polar_depth(view->map, r->distance));
}

/* ---- blocker search ------------------------------------------------------------------------------- */

/* The window in which blockers may lie: begins with all directions that the triangle to the disc crosses, and
 * shrinks to what the nearest distance in it allows. False: nothing is before the receiver. */
static bool search_window(const dpl_shadow_view *view, const dpl_receiver *r, dpl_shadow_counts *counts,
                          dpl_polar_window *window) {
    double half = 1.57079632679489661923 - r->angle;
    for (int k = 0; k < SEARCH_ROUNDS; k++) {
        *window = dpl_polar_window_around(view->map, -r->dx, -r->dy, half);
        double nearest = dpl_polar_nearest(view->map, *window);
        counts->fetches += 2;
        if (nearest >= r->distance)
            return false;
        double next = dpl_penumbra_half_angle(view->radius, nearest, r->distance);
        if (next > 0.98 * half)
            break;
        half = next;
    }
    return true;
}

/* Width of the penumbra at the receiver, in pixels across. */
static double penumbra_width(const dpl_receiver *r, double half) {
    return 2.0 * half * r->distance;
}

dpl_map_term dpl_map_soft_term(const dpl_shadow_view *view, const dpl_receiver *r,
                               dpl_shadow_counts *counts) {
    dpl_map_term term = {1.0, 0.0};
    dpl_polar_window window;
    if (!search_window(view, r, counts, &window))
        return term;
    double b[4], share, depth = dpl_polar_depth(view->map, r->distance);
    counts->fetches += 4;
    dpl_polar_moments(view->map, window, b);
    double blocker = dpl_polar_distance(view->map, dpl_moments_blocker(b, depth, &share));
    double half = dpl_penumbra_half_angle(view->radius, blocker, r->distance);
    term.penumbra = penumbra_width(r, half);
    if (share > 0.99) {
        term.visibility = 0.0;
        return term;
    }
    dpl_polar_moments(view->map, dpl_polar_window_around(view->map, -r->dx, -r->dy, half), b);
    term.visibility = dpl_moments_visibility(b, depth);
    return term;
}

double dpl_shadow_moments_soft(const dpl_shadow_view *view, const dpl_receiver *r,
                               dpl_shadow_counts *counts) {
    return dpl_map_soft_term(view, r, counts).visibility;
}

/* ---- PCSS ----------------------------------------------------------------------------------------- */

/* Distance at a tap: `k` of `taps`, evenly spread over a window. */
static double tap(const dpl_shadow_view *view, dpl_polar_window window, int32_t k, int32_t taps) {
    double at = window.from + (window.to - window.from) * (k + 0.5) / taps;
    return (double)((const float *)view->map->distances.data)[(int32_t)at];
}

dpl_map_term dpl_map_pcss_term(const dpl_shadow_view *view, const dpl_receiver *r,
                               dpl_shadow_counts *counts) {
    dpl_map_term term = {1.0, 0.0};
    dpl_polar_window window;
    if (!search_window(view, r, counts, &window))
        return term;
    int32_t taps = view->desc->samples ? view->desc->samples : DEFAULT_TAPS, blockers = 0, lit = 0;
    double sum = 0.0;
    for (int32_t k = 0; k < taps; k++) {
        double distance = tap(view, window, k, taps);
        blockers += distance < r->distance;
        sum += distance < r->distance ? distance : 0.0;
    }
    counts->fetches += taps;
    if (blockers == 0)
        return term;
    double half = dpl_penumbra_half_angle(view->radius, sum / blockers, r->distance);
    term.penumbra = penumbra_width(r, half);
    window = dpl_polar_window_around(view->map, -r->dx, -r->dy, half);
    for (int32_t k = 0; k < taps; k++)
        lit += tap(view, window, k, taps) >= r->distance;
    counts->fetches += taps;
    term.visibility = (double)lit / taps;
    return term;
}

double dpl_shadow_pcss(const dpl_shadow_view *view, const dpl_receiver *r, dpl_shadow_counts *counts) {
    return dpl_map_pcss_term(view, r, counts).visibility;
}
