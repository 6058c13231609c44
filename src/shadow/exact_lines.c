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

/* Straight sides around all triangles, as far as the light's centre; beyond, sides that do not change. */
typedef struct hull {
    double low, high;             /* v where it begins, at the receivers */
    double low_slope, high_slope; /* v per u */
    double far_low, far_high;     /* of triangles and disc from the light's centre on */
    double along;                 /* to the light's centre */
} hull;

typedef struct walk {
    const dpl_kernels *kernels;
    dpl_lines lines;
    hull hull;
    double radius;
    int32_t own, step;    /* the receivers' line, and which way u goes */
    int32_t careful_from; /* lines from here on may be beyond the disc's rim */
    bool done;            /* no receiver needs more */
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

/* The chain that a run continues; else one that is free or has ended, or the first. */
static inline chain *chain_for(walk *w, int32_t k, int32_t begin, int32_t end, bool careful) {
    chain *other = NULL;
    for (int i = 0; i < CHAINS; i++) {
        chain *c = &w->chains[i];
        bool ended = c->count == 0 || c->line < k - 1;
        if (!ended && c->line < k && c->careful == careful && c->begin <= end && c->end >= begin)
            return c;
        if (ended && !other)
            other = c;
    }
    other = other ? other : &w->chains[0];
    flush(w, other);
    return other;
}

/* Pixels begin .. end-1 of the k-th line. */
static inline void add_run(walk *w, int32_t k, int32_t begin, int32_t end) {
    bool careful = k >= w->careful_from;
    chain *c = chain_for(w, k, begin, end, careful);
    float far = 1.0f / ((float)k + 0.5f);
    c->line = k;
    if (c->count > 0 && c->begin == begin && c->end == end) { /* a rectangle grows */
        c->far[c->count - 1] = far;
        return;
    }
    if (c->count == RUNS)
        flush(w, c);
    c->first_v[c->count] = (float)begin;
    c->end_v[c->count] = (float)end;
    c->near[c->count] = k == 0 ? STRAIGHT_UP : 1.0f / ((float)k - 0.5f);
    c->far[c->count] = far;
    c->count++;
    c->begin = begin;
    c->end = end;
    c->careful = careful;
}

/* ---- lines ---------------------------------------------------------------------------------------- */

/* Pixels that any triangle may reach between two distances from the receivers, and one more at either side;
 * false where that is outside the picture. */
static inline bool reach_between(const walk *w, double near, double far, int32_t *first, int32_t *last) {
    const hull *h = &w->hull;
    double low = h->low + h->low_slope * (h->low_slope < 0.0 ? far : near);
    double high = h->high + h->high_slope * (h->high_slope > 0.0 ? far : near);
    if (far > h->along) {
        low = low < h->far_low ? low : h->far_low;
        high = high > h->far_high ? high : h->far_high;
    }
    return dpl_lines_between(&w->lines, low - 1.0, high + 1.0, first, last);
}

/* Do blocks hold anything between two pixels of their lines? */
static inline bool blocks_hold(walk *w, int32_t block, int32_t first, int32_t last) {
    for (int32_t base = first >> 3; base <= last >> 3; base += 64) {
        w->fetches++;
        if (dpl_lines_blocks(&w->lines, block, base, last >> 3))
            return true;
    }
    return false;
}

/* Pixels first .. last, of which there are at most 64, of the lines from k on. */
static void add_lines(walk *w, int32_t k, int32_t end, int32_t first, int32_t last) {
    int shift = first & 63;
    uint64_t mask = ~(uint64_t)0 >> (63 - (last - first));
    ptrdiff_t step = (ptrdiff_t)w->step * w->lines.words;
    const uint64_t *word = w->lines.bits + (ptrdiff_t)(w->own + w->step * k) * w->lines.words + (first >> 6);
    w->fetches += end - k;
    for (; k < end; k++, word += step) {
        uint64_t bits = (word[0] >> shift | word[1] << 1 << (63 - shift)) & mask;
        while (bits) {
            int32_t begin, behind;
            bits = dpl_lines_take_run(bits, &begin, &behind);
            add_run(w, k, first + begin, first + behind);
        }
    }
}

static void walk_lines(walk *w) {
    int32_t inside = w->step > 0 ? w->lines.u_size - w->own : w->own + 1; /* lines of the picture */
    double reach = w->hull.along + w->radius + 1.5, rim = w->hull.along - w->radius - 1.5;
    w->careful_from = rim > 0.0 ? (int32_t)rim : 0;
    int32_t lines = reach < inside ? (int32_t)reach : inside, k = 0;
    while (k < lines && !w->done) {
        int32_t line = w->own + w->step * k, left = w->step > 0 ? 8 - (line & 7) : (line & 7) + 1;
        int32_t end = k + left < lines ? k + left : lines, first, last;
        if (reach_between(w, k - 0.5, end - 0.5, &first, &last) && blocks_hold(w, line >> 3, first, last))
            for (int32_t base = first; base <= last; base += 64)
                add_lines(w, k, end, base, last - base < 64 ? last : base + 63);
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
    hull *h = &w->hull;
    double low = INFINITY, high = -INFINITY; /* of triangles, at the light's centre */
    *h = (hull){.low = INFINITY, .high = -INFINITY, .along = along};
    for (int i = 0; i < line->count; i++) {
        double v = (double)r->across[i];
        if (r->lost[i])
            continue;
        double from = v + (double)r->from[i] * along, to = v + (double)r->to[i] * along;
        h->low = h->low < v ? h->low : v;
        h->high = v; /* receivers are in rising order */
        low = low < from ? low : from;
        high = high > to ? high : to;
    }
    h->low_slope = (low - h->low) / along;
    h->high_slope = (high - h->high) / along;
    h->far_low = fmin(low, light_v - w->radius);
    h->far_high = fmax(high, light_v + w->radius);
    return h->low <= h->high;
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
