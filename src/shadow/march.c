/* Shadows from marches through the signed distance. A cone of half angle alpha about the ray has, at travel
 * t, its side t sin(alpha) away from the axis: the least of distance / (t sin(alpha)) says how far the
 * nearest edge reaches into the cone, and the arc sine of distance / t at which angle it stands. So the
 * light's size is its own, never a constant. Signs: below 0 the axis runs inside a wall. */
#include "shadow/march.h"

#include "shadow/coverage.h"

#include <math.h>

/* Steps are as long as the distance, and at least this far [px]. Shorter ones cost more and came no closer;
 * from 0.75 on, thin things are passed unseen. */
#define LEAST_STEP 0.5f

static inline float step_of(float distance) {
    return distance > LEAST_STEP ? distance : LEAST_STEP;
}

/* One ray, from the receiver to the disc. */
typedef struct ray {
    float x, y, dx, dy;
    float length; /* to the disc's rim [px] */
    float sine;   /* of the cone's half angle */
} ray;

/* Along one axis: how far a ray from inside the picture goes until it leaves it. */
static double way_out(double start, double direction, double size) {
    return direction > 0.0 ? (size - start) / direction : direction < 0.0 ? -start / direction : INFINITY;
}

/* No longer than within the picture: there is nothing outside. */
static ray ray_within(const dpl_shadow_view *view, const dpl_receiver *r, double dx, double dy, double length,
                      double sine) {
    double out_x = way_out(r->x, dx, view->solid->width), out_y = way_out(r->y, dy, view->solid->height);
    length = fmin(length, fmin(out_x, out_y));
    return (ray){(float)r->x, (float)r->y, (float)dx, (float)dy, (float)length, (float)sine};
}

static ray ray_to_light(const dpl_shadow_view *view, const dpl_receiver *r) {
    return ray_within(view, r, r->dx, r->dy, r->distance - view->radius, r->sine);
}

/* The k-th of n cones that the light's angle is cut into. */
static ray ray_to_part(const dpl_shadow_view *view, const dpl_receiver *r, int32_t k, int32_t n) {
    double turn = r->angle * ((2.0 * k + 1.0) / n - 1.0), c = cos(turn), s = sin(turn);
    double across = r->distance * s, along = r->distance * c;
    double into = sqrt(fmax(view->radius * view->radius - across * across, 0.0));
    return ray_within(view, r, r->dx * c - r->dy * s, r->dy * c + r->dx * s, along - into, sin(r->angle / n));
}

static dpl_distances field_of(const dpl_shadow_view *view) {
    return dpl_mips_level(view->mips, view->solid, view->desc->field_level);
}

/* ---- marches -------------------------------------------------------------------------------------- */

static dpl_field_term march_hard(const dpl_shadow_view *view, const ray *r, dpl_shadow_counts *counts) {
    dpl_distances field = field_of(view);
    int64_t steps = 0;
    float t = 0.0f;
    while (t < r->length) {
        float h = dpl_distances_at(&field, r->x + t * r->dx, r->y + t * r->dy);
        steps++;
        if (h < 0.0f && t > 0.0f)
            break;
        t += step_of(h);
    }
    counts->steps += steps;
    counts->fetches += steps;
    return (dpl_field_term){t < r->length ? 0.0 : 1.0, t < r->length ? (double)t : 0.0};
}

/* Quilez: visible by the narrowest gap, relative to the cone. Only gaps count, so the penumbra begins at the
 * hard shadow's edge, where half of the light is in view. */
static dpl_field_term march_gap(const dpl_shadow_view *view, const ray *r, bool aaltonen,
                                dpl_shadow_counts *counts) {
    dpl_distances field = field_of(view);
    dpl_field_term term = {1.0, 0.0};
    float t = 0.0f, before = INFINITY, narrowest = 1.0f;
    int64_t steps = 0;
    while (t < r->length) {
        float h = dpl_distances_at(&field, r->x + t * r->dx, r->y + t * r->dy), gap = h, at = t;
        steps++;
        if (h < 0.0f && t > 0.0f) {
            narrowest = 0.0f;
            term.gap = (double)t;
            break;
        }
        if (aaltonen && before < INFINITY) { /* nearest point between the last two spheres */
            float y = h * h / (2.0f * before);
            gap = sqrtf(fmaxf(h * h - y * y, 0.0f));
            at = t - y;
        }
        if (at > 0.0f && gap < narrowest * at * r->sine) {
            narrowest = gap / (at * r->sine);
            term.gap = (double)at;
        }
        before = h;
        t += step_of(h);
    }
    counts->steps += steps;
    counts->fetches += steps;
    term.visibility = (double)narrowest;
    return term;
}

/* Angle from the axis to an edge that stands at the sine `ratio`, relative to the cone's half angle. */
static double offset_of(float ratio, float sine) {
    return dpl_coverage_clamp((double)(ratio / sine)) >= 1.0 ? 1.0
           : ratio <= -sine                                  ? -1.0
                                                             : asin((double)ratio) / asin((double)sine);
}

/* Least distance / travel along a ray, no more than the cone's sine; stops when no less can matter. */
static float march_least(const dpl_distances *field, const ray *r, float *gap, int64_t *steps) {
    float least = r->sine, t = LEAST_STEP;
    for (; t < r->length; ++*steps) {
        float h = dpl_distances_at(field, r->x + t * r->dx, r->y + t * r->dy);
        if (h < least * t) {
            least = h / t;
            *gap = t;
            if (least <= -r->sine)
                break;
        }
        t += step_of(fabsf(h));
    }
    return least;
}

static dpl_field_term march_signed(const dpl_shadow_view *view, const ray *r, dpl_shadow_counts *counts) {
    dpl_distances field = field_of(view);
    int64_t steps = 0;
    float gap = 0.0f;
    double visibility = dpl_coverage_interval(offset_of(march_least(&field, r, &gap, &steps), r->sine));
    counts->steps += steps;
    counts->fetches += steps;
    return (dpl_field_term){visibility, (double)gap};
}

/* The edges to the left and to the right of the axis each take what they cover. */
static dpl_field_term march_two_sided(const dpl_shadow_view *view, const ray *r, dpl_shadow_counts *counts) {
    dpl_distances field = field_of(view);
    float least[2] = {r->sine, r->sine}, t = LEAST_STEP, gap = 0.0f;
    int64_t steps = 0;
    for (; t < r->length; steps++) {
        float slope[2], h = dpl_distances_slope(&field, r->x + t * r->dx, r->y + t * r->dy, slope);
        int side = r->dx * slope[1] - r->dy * slope[0] > 0.0f; /* the blocker is where distances fall */
        if (h < least[side] * t) {
            least[side] = h / t;
            gap = t;
            if (least[side] <= -r->sine) /* covers the other side's half too */
                break;
        }
        t += step_of(fabsf(h));
    }
    counts->steps += steps;
    counts->fetches += steps;
    double sum = offset_of(least[0], r->sine) + offset_of(least[1], r->sine);
    return (dpl_field_term){fmax(0.5 * sum, 0.0), (double)gap};
}

static dpl_field_term march_cones(const dpl_shadow_view *view, const dpl_receiver *receiver,
                                  dpl_shadow_counts *counts) {
    int32_t count = view->desc->sub_cones;
    dpl_field_term term = {0.0, 0.0};
    for (int32_t k = 0; k < count; k++) {
        ray part = ray_to_part(view, receiver, k, count);
        dpl_field_term one = march_two_sided(view, &part, counts);
        term.visibility += one.visibility / count;
        term.gap = fmax(term.gap, one.gap);
    }
    return term;
}

dpl_field_term dpl_field_term_of(const dpl_shadow_view *view, const dpl_receiver *receiver,
                                 dpl_shadow_method method, dpl_shadow_counts *counts) {
    ray r = ray_to_light(view, receiver);
    if (!(view->radius > 0.0) || method == DPL_SHADOW_DISTANCE_HARD)
        return march_hard(view, &r, counts);
    switch (method) {
    case DPL_SHADOW_DISTANCE_QUILEZ:
        return march_gap(view, &r, false, counts);
    case DPL_SHADOW_DISTANCE_AALTONEN:
        return march_gap(view, &r, true, counts);
    case DPL_SHADOW_DISTANCE_SIGNED:
        return march_signed(view, &r, counts);
    case DPL_SHADOW_DISTANCE_TWO_SIDED:
        return march_two_sided(view, &r, counts);
    default:
        return march_cones(view, receiver, counts);
    }
}

/* ---- as methods of their own ---------------------------------------------------------------------- */

double dpl_shadow_hard(const dpl_shadow_view *view, const dpl_receiver *r, dpl_shadow_counts *counts) {
    return dpl_field_term_of(view, r, DPL_SHADOW_DISTANCE_HARD, counts).visibility;
}

double dpl_shadow_quilez(const dpl_shadow_view *view, const dpl_receiver *r, dpl_shadow_counts *counts) {
    return dpl_field_term_of(view, r, DPL_SHADOW_DISTANCE_QUILEZ, counts).visibility;
}

double dpl_shadow_aaltonen(const dpl_shadow_view *view, const dpl_receiver *r, dpl_shadow_counts *counts) {
    return dpl_field_term_of(view, r, DPL_SHADOW_DISTANCE_AALTONEN, counts).visibility;
}

double dpl_shadow_signed(const dpl_shadow_view *view, const dpl_receiver *r, dpl_shadow_counts *counts) {
    return dpl_field_term_of(view, r, DPL_SHADOW_DISTANCE_SIGNED, counts).visibility;
}

double dpl_shadow_two_sided(const dpl_shadow_view *view, const dpl_receiver *r, dpl_shadow_counts *counts) {
    return dpl_field_term_of(view, r, DPL_SHADOW_DISTANCE_TWO_SIDED, counts).visibility;
}

double dpl_shadow_cones(const dpl_shadow_view *view, const dpl_receiver *r, dpl_shadow_counts *counts) {
    return dpl_field_term_of(view, r, DPL_SHADOW_DISTANCE_CONES, counts).visibility;
}
