/* What opaque pixels cover of the disc, for a line of receivers at once. One walk goes over the hull of their
 * triangles, line by line of bits; runs of opaque pixels that touch each other make a chain, and a chain
 * covers all slopes between its least and its greatest, as nothing passes between two pixels that touch. So a
 * receiver needs no more of a run than four products, and spans are put together once per chain (kernel
 * `cover_runs`). Slopes are v per u, which keeps connected what is before the receivers.
 *
 * Near the disc a pixel may be before it for one ray and behind it for another: receivers that see any there
 * are left to exact.c. */
#include "shadow/exact_lines.h"

#include "shadow/lines.h"

#include <math.h>

/* Chains that grow at the same time, and runs that are kept of one before they are added. */
enum { CHAINS = 8, RUNS = 32 };

/* Stands for 1 / 0, where a line begins at the receivers themselves. */
#define STRAIGHT_UP 1e6f

typedef struct chain {
    int32_t count;
    int32_t line;       /* of the last run … */
    int32_t begin, end; /* … and its pixels */
    bool careful;
    float first_v[RUNS], end_v[RUNS], near[RUNS], far[RUNS];
} chain;

typedef struct hull {
    double low, high;         /* v of the receivers */
    double far_low, far_high; /* and where their triangles are as far as the light's centre */
    double disc_low, disc_high;
    double along; /* to the light's centre */
} hull;

typedef struct walk {
    const dpl_kernels *kernels;
    dpl_lines lines;
    hull hull;
    double radius;
    int32_t own, step; /* the receivers' line, and which way u goes */
    bool done;         /* no receiver needs more */
    int64_t fetches;
    dpl_receivers receivers;
    chain chains[CHAINS];
} walk;

/* ---- chains --------------------------------------------------------------------------------------- */

static void flush(walk *w, chain *c) {
    if (c->count == 0)
        return;
    dpl_runs runs = {c->count, c->first_v, c->end_v, c->near, c->far};
    w->done = w->kernels->cover_runs(&w->receivers, &runs, c->careful);
    c->count = 0;
}

/* The chain that a run continues; else one that is free, or that has ended, or the first. */
static chain *chain_for(walk *w, int32_t k, int32_t begin, int32_t end, bool careful) {
    chain *other = &w->chains[0];
    for (int i = CHAINS - 1; i >= 0; i--) {
        chain *c = &w->chains[i];
        if (c->count > 0 && c->line == k - 1 && c->careful == careful && c->begin <= end && c->end >= begin)
            return c;
        if (c->count == 0 || c->line < k - 1)
            other = c;
    }
    flush(w, other);
    return other;
}

/* Pixels begin .. end-1 of the k-th line. */
static void add_run(walk *w, int32_t k, int32_t begin, int32_t end, bool careful) {
    chain *c = chain_for(w, k, begin, end, careful);
    if (c->count == RUNS)
        flush(w, c);
    c->first_v[c->count] = (float)begin;
    c->end_v[c->count] = (float)end;
    c->near[c->count] = k == 0 ? STRAIGHT_UP : 1.0f / ((float)k - 0.5f);
    c->far[c->count] = 1.0f / ((float)k + 0.5f);
    c->count++;
    c->line = k;
    c->begin = begin;
    c->end = end;
    c->careful = careful;
}

/* ---- lines ---------------------------------------------------------------------------------------- */

/* Pixels that any triangle may reach between two distances from the receivers, and one more at either side;
 * false where that is outside the picture. */
static bool reach_between(const walk *w, double near, double far, int32_t *first, int32_t *last) {
    const hull *h = &w->hull;
    double a = fmax(near, 0.0) / h->along, b = far / h->along;
    double low = fmin(h->low + fmin(a, 1.0) * (h->far_low - h->low),
                      h->low + fmin(b, 1.0) * (h->far_low - h->low));
    double high = fmax(h->high + fmin(a, 1.0) * (h->far_high - h->high),
                       h->high + fmin(b, 1.0) * (h->far_high - h->high));
    if (b > 1.0) {
        low = fmin(low, h->disc_low);
        high = fmax(high, h->disc_high);
    }
    return dpl_lines_between(&w->lines, low - 1.0, high + 1.0, first, last);
}

static bool block_is_empty(walk *w, int32_t block, double near, double far) {
    int32_t first, last;
    if (!reach_between(w, near, far, &first, &last))
        return true;
    for (int32_t base = first >> 3; base <= last >> 3; base += 64) {
        w->fetches++;
        if (dpl_lines_blocks(&w->lines, block, base, last >> 3))
            return false;
    }
    return true;
}

static void add_line(walk *w, int32_t k) {
    int32_t first, last, begin, end;
    bool careful = k + 0.5 > w->hull.along - w->radius - 1.0;
    if (!reach_between(w, k - 0.5, k + 0.5, &first, &last))
        return;
    for (int32_t base = first; base <= last; base += 64) {
        uint64_t bits = dpl_lines_window(&w->lines, w->own + w->step * k, base, last);
        w->fetches++;
        while (bits) {
            bits = dpl_lines_take_run(bits, &begin, &end);
            add_run(w, k, base + begin, base + end, careful);
        }
    }
}

static void walk_lines(walk *w) {
    int32_t inside = w->step > 0 ? w->lines.u_size - w->own : w->own + 1; /* lines of the picture */
    double reach = w->hull.along + w->radius + 1.5;
    int32_t lines = reach < inside ? (int32_t)reach : inside, k = 0;
    while (k < lines && !w->done) {
        int32_t line = w->own + w->step * k, left = w->step > 0 ? 8 - (line & 7) : (line & 7) + 1;
        int32_t end = k + left < lines ? k + left : lines;
        if (!block_is_empty(w, line >> 3, k - 0.5, end - 0.5))
            for (; k < end; k++)
                add_line(w, k);
        k = end;
    }
    for (int i = 0; i < CHAINS; i++)
        flush(w, &w->chains[i]);
}

/* ---- receivers ------------------------------------------------------------------------------------ */

/* Faces the disc, and finds the hull of what receivers have to look at; false when all are lost. */
static bool face(walk *w, const dpl_receiver_line *line, double light_u, double light_v) {
    dpl_receivers *r = &w->receivers;
    double own = line->u + 0.5, along = fabs(light_u - own);
    w->step = light_u > own ? 1 : -1;
    w->own = line->u;
    r->along = (float)along;
    r->radius = (float)w->radius;
    for (int i = 0; i < DPL_RECEIVERS; i++) {
        int32_t v = line->v[i < line->count ? i : 0];
        r->across[i] = (float)v + 0.5f;
        r->toward[i] = (float)(light_v - v - 0.5);
    }
    w->kernels->face_disc(r);
    w->hull = (hull){INFINITY, -INFINITY, INFINITY, -INFINITY, light_v - w->radius, light_v + w->radius, along};
    for (int i = 0; i < line->count; i++) {
        if (r->lost[i])
            continue;
        double v = (double)r->across[i];
        w->hull.low = fmin(w->hull.low, v);
        w->hull.high = fmax(w->hull.high, v);
        w->hull.far_low = fmin(w->hull.far_low, v + (double)r->from[i] * along);
        w->hull.far_high = fmax(w->hull.far_high, v + (double)r->to[i] * along);
    }
    return w->hull.low <= w->hull.high;
}

void dpl_shadow_exact_line(const dpl_shadow_view *view, dpl_receiver_line *line, dpl_shadow_counts *counts) {
    walk w;
    w.kernels = view->field->context->kernels;
    w.lines = dpl_lines_of(view->solid, line->turned);
    w.radius = view->radius;
    w.done = false;
    w.fetches = 0;
    for (int i = 0; i < CHAINS; i++)
        w.chains[i].count = 0;
    if (face(&w, line, view->position[line->turned], view->position[!line->turned]))
        walk_lines(&w);
    float visible[DPL_RECEIVERS];
    w.kernels->share_seen(&w.receivers, visible);
    memcpy(line->visible, visible, (size_t)line->count * sizeof *visible);
    counts->steps += w.fetches;
    counts->fetches += w.fetches;
}
