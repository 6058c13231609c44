/* What runs of opaque pixels cover of a disc of light, the scalar reference. */
#include "kernel/cover_ref.h"

#include "kernel/sight.h"

#include <math.h>

void dpl_face_disc_ref(dpl_receivers *r) {
    for (int i = 0; i < DPL_RECEIVERS; i++) {
        float u = r->along, v = r->toward[i], square = u * u + v * v;
        float root = sqrtf(square - r->radius * r->radius);
        float low = u * root + v * r->radius, high = u * root - v * r->radius; /* of the sides, along */
        r->from[i] = (v * root - u * r->radius) / low;
        r->to[i] = (v * root + u * r->radius) / high;
        r->lost[i] = low > LEAST_SIDE * square && high > LEAST_SIDE * square ? 0 : -1;
        for (int k = 0; k < DPL_RECEIVER_SPANS; k++) {
            r->low[k][i] = STEEPEST;
            r->high[k][i] = -STEEPEST;
        }
    }
}

/* Adds a span that is not empty; spans that it touches become part of it. Returns false for want of room. */
static bool add_span(dpl_receivers *r, int i, float low, float high) {
    for (int k = 0; k < DPL_RECEIVER_SPANS; k++) {
        if (!(low <= r->high[k][i] && r->low[k][i] <= high))
            continue;
        low = low < r->low[k][i] ? low : r->low[k][i];
        high = high > r->high[k][i] ? high : r->high[k][i];
        r->low[k][i] = STEEPEST;
        r->high[k][i] = -STEEPEST;
    }
    for (int k = 0; k < DPL_RECEIVER_SPANS; k++)
        if (r->low[k][i] > r->high[k][i]) {
            r->low[k][i] = low;
            r->high[k][i] = high;
            return true;
        }
    return false;
}

bool dpl_cover_runs_ref(dpl_receivers *r, const dpl_runs *runs, bool careful) {
    bool done = true;
    for (int i = 0; i < DPL_RECEIVERS; i++) {
        float low = STEEPEST, high = -STEEPEST;
        for (int32_t k = 0; k < runs->count; k++) {
            float first = runs->first[k] - r->across[i], end = runs->end[k] - r->across[i];
            float a = first * runs->near[k], b = first * runs->far[k];
            float c = end * runs->near[k], d = end * runs->far[k];
            low = low < a ? low : a;
            low = low < b ? low : b;
            high = high > c ? high : c;
            high = high > d ? high : d;
        }
        low = low > r->from[i] ? low : r->from[i];
        high = high < r->to[i] ? high : r->to[i];
        if (low < high && !r->lost[i])
            r->lost[i] = careful || !add_span(r, i, low, high) ? -1 : 0;
        bool covered = false;
        for (int k = 0; k < DPL_RECEIVER_SPANS; k++)
            covered = covered || (r->low[k][i] <= r->from[i] && r->high[k][i] >= r->to[i]);
        done = done && (covered || r->lost[i]);
    }
    return done;
}

static float arc_tangent(float x) {
    float u = x * x;
    return x * (ATAN_0 + u * (ATAN_1 + u * (ATAN_2 + u * (ATAN_3 + u * (ATAN_4 + u * ATAN_5)))));
}

/* Angle from the disc's centre of a slope that lies on the disc. */
static float angle_of_slope(const dpl_receivers *r, int i, float slope) {
    return arc_tangent((slope * r->along - r->toward[i]) / (r->along + slope * r->toward[i]));
}

void dpl_share_seen_ref(const dpl_receivers *r, float *visible) {
    for (int i = 0; i < DPL_RECEIVERS; i++) {
        float square = r->along * r->along + r->toward[i] * r->toward[i], covered = 0.0f;
        float half = arc_tangent(r->radius / sqrtf(square - r->radius * r->radius));
        bool whole = false;
        for (int k = 0; k < DPL_RECEIVER_SPANS; k++) {
            bool empty = r->low[k][i] > r->high[k][i];
            float low = empty ? 0.0f : r->low[k][i], high = empty ? 0.0f : r->high[k][i];
            float angle = angle_of_slope(r, i, high) - angle_of_slope(r, i, low);
            whole = whole || (r->low[k][i] <= r->from[i] && r->high[k][i] >= r->to[i]);
            covered += angle;
        }
        float seen = 1.0f - covered / (2.0f * half);
        seen = seen > 0.0f && !whole ? seen : 0.0f;
        visible[i] = r->lost[i] ? -1.0f : seen;
    }
}
