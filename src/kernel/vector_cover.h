/* What runs of opaque pixels cover of a disc of light, in vectors: in lanes what cover_ref.c does in
 * sequence, operation for operation. Included by vector.c alone. */
#ifndef DPL_KERNEL_VECTOR_COVER_H
#define DPL_KERNEL_VECTOR_COVER_H

#include "kernel/kernel.h"
#include "kernel/sight.h"
#include "kernel/simd.h"

static inline vfloat load_lanes(const float *from) {
    return load_some(from, LANES);
}

static inline void store_lanes(float *to, vfloat v) {
    store_some(to, v, LANES);
}

static inline vint load_lane_ints(const int32_t *from) {
    vint v;
    memcpy(&v, from, sizeof v);
    return v;
}

static void face_disc(dpl_receivers *r) {
    for (int i = 0; i < DPL_RECEIVERS; i += LANES) {
        vfloat u = all_float(r->along), v = load_lanes(r->toward + i), square = u * u + v * v;
        vfloat root = square_root(square - r->radius * r->radius);
        vfloat low = u * root + v * r->radius, high = u * root - v * r->radius;
        store_lanes(r->from + i, (v * root - u * r->radius) / low);
        store_lanes(r->to + i, (v * root + u * r->radius) / high);
        store_some_ints(r->lost + i, ~((low > LEAST_SIDE * square) & (high > LEAST_SIDE * square)), LANES);
        for (int k = 0; k < DPL_RECEIVER_SPANS; k++) {
            store_lanes(r->low[k] + i, all_float(STEEPEST));
            store_lanes(r->high[k] + i, all_float(-STEEPEST));
        }
    }
}

static inline vfloat lesser(vfloat a, vfloat b) {
    return select_float(a < b, a, b);
}

static inline vfloat greater(vfloat a, vfloat b) {
    return select_float(a > b, a, b);
}

/* In some lanes; returns those for which there is no room. */
static inline vint add_span(dpl_receivers *r, int i, vint some, vfloat low, vfloat high) {
    for (int k = 0; k < DPL_RECEIVER_SPANS; k++) {
        vfloat k_low = load_lanes(r->low[k] + i), k_high = load_lanes(r->high[k] + i);
        vint touches = some & (low <= k_high) & (k_low <= high);
        if (!any(touches))
            continue;
        low = select_float(touches, lesser(low, k_low), low);
        high = select_float(touches, greater(high, k_high), high);
        store_lanes(r->low[k] + i, select_float(touches, all_float(STEEPEST), k_low));
        store_lanes(r->high[k] + i, select_float(touches, all_float(-STEEPEST), k_high));
    }
    for (int k = 0; k < DPL_RECEIVER_SPANS && any(some); k++) {
        vfloat k_low = load_lanes(r->low[k] + i), k_high = load_lanes(r->high[k] + i);
        vint here = some & (k_low > k_high);
        store_lanes(r->low[k] + i, select_float(here, low, k_low));
        store_lanes(r->high[k] + i, select_float(here, high, k_high));
        some &= ~here;
    }
    return some;
}

/* Receivers that see nothing. */
static inline vint are_covered(const dpl_receivers *r, int i) {
    vfloat from = load_lanes(r->from + i), to = load_lanes(r->to + i);
    vint covered = all_int(0);
    for (int k = 0; k < DPL_RECEIVER_SPANS; k++)
        covered |= (load_lanes(r->low[k] + i) <= from) & (load_lanes(r->high[k] + i) >= to);
    return covered;
}

static bool cover_runs(dpl_receivers *r, const dpl_runs *runs, bool careful) {
    bool done = true;
    for (int i = 0; i < DPL_RECEIVERS; i += LANES) {
        vfloat across = load_lanes(r->across + i), low = all_float(STEEPEST), high = all_float(-STEEPEST);
        for (int32_t k = 0; k < runs->count; k++) {
            vfloat first = runs->first[k] - across, end = runs->end[k] - across;
            low = lesser(lesser(low, first * runs->near[k]), first * runs->far[k]);
            high = greater(greater(high, end * runs->near[k]), end * runs->far[k]);
        }
        low = greater(low, load_lanes(r->from + i));
        high = lesser(high, load_lanes(r->to + i));
        vint lost = load_lane_ints(r->lost + i), some = (low < high) & ~lost;
        if (any(some))
            lost |= careful ? some : add_span(r, i, some, low, high);
        store_some_ints(r->lost + i, lost, LANES);
        done = done && !any(~(are_covered(r, i) | lost));
    }
    return done;
}

static inline vfloat arc_tangent(vfloat x) {
    vfloat u = x * x;
    return x * (ATAN_0 + u * (ATAN_1 + u * (ATAN_2 + u * (ATAN_3 + u * (ATAN_4 + u * ATAN_5)))));
}

static inline vfloat angle_of_slope(const dpl_receivers *r, vfloat toward, vfloat slope) {
    return arc_tangent((slope * r->along - toward) / (r->along + slope * toward));
}

static void share_seen(const dpl_receivers *r, float *visible) {
    for (int i = 0; i < DPL_RECEIVERS; i += LANES) {
        vfloat toward = load_lanes(r->toward + i), covered = {0};
        vfloat square = r->along * r->along + toward * toward;
        vfloat half = arc_tangent(r->radius / square_root(square - r->radius * r->radius));
        for (int k = 0; k < DPL_RECEIVER_SPANS; k++) {
            vfloat low = load_lanes(r->low[k] + i), high = load_lanes(r->high[k] + i);
            vint holds = ~(low > high);
            if (!any(holds))
                continue; /* nothing, exactly */
            low = (vfloat)((vint)low & holds);
            high = (vfloat)((vint)high & holds);
            covered += angle_of_slope(r, toward, high) - angle_of_slope(r, toward, low);
        }
        vfloat seen = 1.0f - covered / (2.0f * half);
        seen = select_float((seen > 0.0f) & ~are_covered(r, i), seen, all_float(0.0f));
        store_lanes(visible + i, select_float(load_lane_ints(r->lost + i), all_float(-1.0f), seen));
    }
}

#endif
