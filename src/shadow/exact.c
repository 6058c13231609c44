/* The exact method: the union of the angles that opaque pixels cover before the disc, seen from a receiver.
 * Works on the pixel world itself, so that it equals the truth for shapes, pictures and raw buffers alike.
 *
 * The triangle between the receiver and the disc is walked column by column (or row by row, along the longer
 * axis), 64 pixels of a column at a time as bits, and blocks of 8 x 8 pixels first. A run of opaque pixels
 * covers the slopes between two of its corners. Pixels near the disc or beside the receiver are cut edge by
 * edge. Slopes are tangents of angles from the line to the light's centre.
 *
 * Cost: columns that hold something, not shapes; a light's angle that is covered whole ends the walk. */
#include "shadow/cover.h"
#include "shadow/lines.h"
#include "shadow/shadow.h"

#include <math.h>

/* The walk's own coordinates: u along, v across; bits of one u are a line. */
typedef struct walk {
    const dpl_shadow_view *view;
    dpl_cover *cover;
    dpl_lines lines;
    double u, v;             /* receiver */
    double au, av;           /* unit direction to the light's centre */
    double distance;         /* to it */
    double tangent;          /* of half the light's angle */
    double low, high;        /* slopes v / |u| of the triangle's sides */
    int32_t step;            /* -1 or 1: which way u goes */
    double light_u, light_v; /* the light's centre */
    int32_t columns;         /* left to walk */
    bool is_turned;          /* u is y */
    bool is_wide;            /* a side of the triangle runs against u: take its whole box */
    double box_low, box_high;
    int64_t steps, fetches;
} walk;

/* ---- pixels that need care ------------------------------------------------------------------------ */

/* A point relative to the receiver: along the line to the light's centre, and across it. */
typedef struct point {
    double along, across;
} point;

static point seen(const walk *w, double u, double v) {
    double du = u - w->u, dv = v - w->v;
    return (point){du * w->au + dv * w->av, dv * w->au - du * w->av};
}

/* Cuts the stretch from .. to of a line a + t (b - a) to where value(a) + t (value(b) - value(a)) <= 0. */
static void cut(double value_a, double value_b, double *from, double *to) {
    bool a_is_out = value_a > 0.0, b_is_out = value_b > 0.0;
    if (a_is_out && b_is_out)
        *to = -1.0;
    else if (a_is_out)
        *from = fmax(*from, value_a / (value_a - value_b));
    else if (b_is_out)
        *to = fmin(*to, value_a / (value_a - value_b));
}

static void add_piece(walk *w, point a, point b, double from, double to) {
    double chord = w->distance - w->view->radius * w->view->radius / w->distance;
    double middle = 0.5 * (from + to);
    if (!(from < to) || a.along + middle * (b.along - a.along) > chord)
        return;
    double s[2], t[2] = {from, to};
    for (int k = 0; k < 2; k++)
        s[k] = (a.across + t[k] * (b.across - a.across)) / (a.along + t[k] * (b.along - a.along));
    dpl_cover_add(w->cover, fmin(s[0], s[1]), fmax(s[0], s[1]));
}

/* Adds the parts of an edge that lie inside the triangle and outside the disc. */
static void add_edge(walk *w, point a, point b) {
    double from = 0.0, to = 1.0;
    cut(a.across - a.along * w->tangent, b.across - b.along * w->tangent, &from, &to);
    cut(-a.across - a.along * w->tangent, -b.across - b.along * w->tangent, &from, &to);
    if (!(from < to))
        return;
    double x = a.along - w->distance, dx = b.along - a.along, dy = b.across - a.across;
    double square = dx * dx + dy * dy, half = x * dx + a.across * dy;
    double rest = x * x + a.across * a.across - w->view->radius * w->view->radius;
    double discriminant = half * half - square * rest;
    if (!(discriminant > 0.0)) {
        add_piece(w, a, b, from, to);
        return;
    }
    double root = sqrt(discriminant);
    add_piece(w, a, b, from, fmin(to, (-half - root) / square));
    add_piece(w, a, b, fmax(from, (-half + root) / square), to);
}

static void add_square(walk *w, double u, double v) {
    point corners[4] = {seen(w, u, v), seen(w, u + 1.0, v), seen(w, u + 1.0, v + 1.0), seen(w, u, v + 1.0)};
    for (int k = 0; k < 4; k++)
        add_edge(w, corners[k], corners[(k + 1) % 4]);
}

/* A whole rectangle at once, where that is as good: wholly inside the disc, where it counts for nothing, or
 * before the disc, clear of it and not beside the receiver. */
static bool add_rectangle(walk *w, double u, double v, double height) {
    double square = w->view->radius * w->view->radius, chord = w->distance - square / w->distance;
    double low = INFINITY, high = -INFINITY;
    int within = 0;
    bool before = true;
    for (int k = 0; k < 4; k++) {
        point p = seen(w, u + (k & 1), v + (k & 2 ? height : 0.0));
        double x = p.along - w->distance, s = p.across / p.along;
        within += x * x + p.across * p.across <= square;
        before = before && p.along > 0.25 && p.along < chord;
        low = s < low ? s : low;
        high = s > high ? s : high;
    }
    if (within == 4)
        return true;
    if (!before)
        return false;
    double du = fmax(fabs(w->light_u - u - 0.5) - 0.5, 0.0);
    double dv = fmax(fabs(w->light_v - v - 0.5 * height) - 0.5 * height, 0.0);
    if (du * du + dv * dv < square)
        return false;
    dpl_cover_add(w->cover, low, high);
    return true;
}

static void add_with_care(walk *w, int32_t column, int32_t first, int32_t end) {
    if (add_rectangle(w, column, first, end - first))
        return;
    for (int32_t v = first; v < end; v++)
        if (!add_rectangle(w, column, v, 1.0))
            add_square(w, column, v);
}

/* ---- columns -------------------------------------------------------------------------------------- */

/* A run of opaque pixels first .. end-1, whose sides are `near` and `far` from the receiver along u. */
static void add_run(walk *w, int32_t column, int32_t first, int32_t end, double near, double far,
                    bool careful) {
    if (careful) {
        add_with_care(w, column, first, end);
        return;
    }
    double low = first - w->v, high = end - w->v;
    double low_u = w->step * (low < 0.0 ? near : far), high_u = w->step * (high > 0.0 ? near : far);
    double s0 = (low * w->au - low_u * w->av) / (low_u * w->au + low * w->av);
    double s1 = (high * w->au - high_u * w->av) / (high_u * w->au + high * w->av);
    dpl_cover_add(w->cover, s0 < s1 ? s0 : s1, s0 < s1 ? s1 : s0);
}

static void add_bits(walk *w, int32_t column, int32_t base, uint64_t bits, double near, bool careful) {
    while (bits) {
        int32_t begin, end;
        bits = dpl_lines_take_run(bits, &begin, &end);
        add_run(w, column, base + begin, base + end, near, near + 1.0, careful);
    }
}

/* Adds what one column holds between two pixels, both included. */
static inline void add_column(walk *w, int32_t column, int32_t first, int32_t last, double near,
                              bool careful) {
    for (int32_t base = first; base <= last; base += 64) {
        uint64_t bits = dpl_lines_window(&w->lines, column, base, last);
        w->fetches++;
        if (bits)
            add_bits(w, column, base, bits, near, careful);
    }
}

/* Is there nothing between two places of a block of 8 columns? */
static inline bool block_is_empty(walk *w, int32_t block, double low, double high) {
    int32_t first, last;
    if (!dpl_lines_between(&w->lines, low, high, &first, &last))
        return true;
    for (int32_t base = first >> 3; base <= last >> 3; base += 64) {
        w->fetches++;
        if (dpl_lines_blocks(&w->lines, block, base, last >> 3))
            return false;
    }
    return true;
}

/* The column of the receiver itself, in which the triangle begins. */
static void walk_own_column(walk *w, int32_t own, double near) {
    int32_t first, last;
    double low = w->low * (near + 1.0), high = w->high * (near + 1.0);
    w->steps++;
    if (dpl_lines_between(&w->lines, w->v + (low < 0.0 ? low : 0.0), w->v + (high > 0.0 ? high : 0.0), &first,
                          &last))
        add_column(w, own, first, last, near, true);
}

/* Along the triangle, from the receiver to the disc: column k has its near side at near + k. */
static void walk_columns(walk *w) {
    int32_t own = (int32_t)w->u, first, last;
    double near = w->step > 0 ? own - w->u : w->u - own - 1.0; /* behind the receiver */
    double first_low = w->v + w->low * (w->low < 0.0 ? near + 1.0 : near);
    double first_high = w->v + w->high * (w->high > 0.0 ? near + 1.0 : near);
    double careful_from = w->step * (w->light_u - w->u) - w->view->radius - 1.0 - near;
    if (w->tangent > 0.5)
        careful_from = 0.0;
    int32_t inside = w->step > 0 ? w->lines.u_size - own : own + 1; /* columns of the picture from here on */
    int32_t columns = inside < w->columns ? inside : w->columns, k = 1;
    walk_own_column(w, own, near);
    while (k < columns && !dpl_cover_is_full(w->cover)) {
        int32_t column = own + w->step * k, left = w->step > 0 ? 8 - (column & 7) : (column & 7) + 1;
        int32_t end = k + left < columns ? k + left : columns;
        w->steps++;
        if (block_is_empty(w, column >> 3, first_low + w->low * (w->low < 0.0 ? end - 1 : k),
                           first_high + w->high * (w->high > 0.0 ? end - 1 : k))) {
            k = end;
            continue;
        }
        for (; k < end; k++, column += w->step) {
            w->steps++;
            if (dpl_lines_between(&w->lines, first_low + w->low * k, first_high + w->high * k, &first, &last))
                add_column(w, column, first, last, near + k, k <= 2 || k >= careful_from);
        }
    }
}

/* All of the box around a triangle that is too wide for slopes. */
static void walk_box(walk *w) {
    int32_t first, last;
    if (!dpl_lines_between(&w->lines, w->low, w->high, &first, &last))
        return;
    int32_t column = w->box_low > 0.0 ? (int32_t)w->box_low : 0;
    while (column < w->lines.u_size && column <= w->box_high && !dpl_cover_is_full(w->cover)) {
        w->steps++;
        if (block_is_empty(w, column >> 3, w->low, w->high))
            column = (column | 7) + 1;
        else
            add_column(w, column++, first, last, 0.0, true);
    }
}

/* ---- the triangle --------------------------------------------------------------------------------- */

/* Slopes of the two sides, or the box of a triangle too wide for slopes. */
static void lay_out(walk *w, double sine) {
    double cosine = sqrt(1.0 - sine * sine), tangent_length = w->distance * cosine;
    double side_u[2], side_v[2];
    for (int k = 0; k < 2; k++) {
        double s = k ? sine : -sine;
        side_u[k] = w->au * cosine - w->av * s;
        side_v[k] = w->av * cosine + w->au * s;
    }
    double end_u[2] = {side_u[0] * tangent_length, side_u[1] * tangent_length};
    w->is_wide = !(w->step * side_u[0] > 0.2 && w->step * side_u[1] > 0.2);
    if (!w->is_wide) {
        double a = side_v[0] / (w->step * side_u[0]), b = side_v[1] / (w->step * side_u[1]);
        w->low = fmin(a, b);
        w->high = fmax(a, b);
        double reach = fmax(w->step * end_u[0], w->step * end_u[1]);
        w->columns = (int32_t)fmin(reach + 2.0, 4.0 * DPL_MAX_SIZE);
        return;
    }
    w->box_low = w->u + fmin(0.0, fmin(end_u[0], end_u[1]));
    w->box_high = w->u + fmax(0.0, fmax(end_u[0], end_u[1]));
    w->low = w->v + tangent_length * fmin(0.0, fmin(side_v[0], side_v[1]));
    w->high = w->v + tangent_length * fmax(0.0, fmax(side_v[0], side_v[1]));
}

static walk start_walk(const dpl_shadow_view *view, const dpl_receiver *r, dpl_cover *cover) {
    bool turned = fabs(r->dy) > fabs(r->dx);
    walk w = {.view = view, .cover = cover, .is_turned = turned};
    w.lines = dpl_lines_of(view->solid, turned);
    w.u = turned ? r->y : r->x;
    w.v = turned ? r->x : r->y;
    w.au = turned ? r->dy : r->dx;
    w.av = turned ? r->dx : r->dy;
    w.step = w.au > 0.0 ? 1 : -1;
    w.light_u = w.u + w.au * r->distance;
    w.light_v = w.v + w.av * r->distance;
    w.distance = r->distance;
    w.tangent = r->sine / sqrt(1.0 - r->sine * r->sine);
    cover->limit = w.tangent;
    cover->count = 0;
    lay_out(&w, r->sine);
    return w;
}

/* Fills the cover with what is covered of the disc; returns whether the walk was turned, which mirrors the
 * signs of slopes. */
static bool cover_disc(const dpl_shadow_view *view, const dpl_receiver *r, dpl_cover *cover,
                       dpl_shadow_counts *counts) {
    walk w = start_walk(view, r, cover);
    if (w.is_wide)
        walk_box(&w);
    else
        walk_columns(&w);
    counts->steps += w.steps;
    counts->fetches += w.fetches;
    return w.is_turned;
}

double dpl_shadow_exact(const dpl_shadow_view *view, const dpl_receiver *r, dpl_shadow_counts *counts) {
    if (!(view->radius > 0.0))
        return dpl_solid_first_hit(view->solid, r->x, r->y, r->dx, r->dy, r->distance) < INFINITY ? 0.0 : 1.0;
    dpl_cover cover; /* large, and only its first entries are ever touched */
    (void)cover_disc(view, r, &cover, counts);
    if (dpl_cover_is_full(&cover))
        return 0.0;
    double covered = 0.0;
    for (int i = 0; i < cover.count; i++)
        covered += atan(cover.high[i]) - atan(cover.low[i]);
    return fmax(1.0 - 0.5 * covered / r->angle, 0.0);
}

/* Integral of max(cos, 0) up to an angle within 3/2 pi of 0. */
static double cosines_to(double angle) {
    static const double HALF_PI = 1.57079632679489661923;
    return sin(fmax(-HALF_PI, fmin(angle, HALF_PI)));
}

double dpl_shadow_exact_facing(const dpl_shadow_view *view, const dpl_receiver *r, const int32_t normal[2],
                               dpl_shadow_counts *counts) {
    double middle =
        atan2(normal[0] * r->dy - normal[1] * r->dx, normal[0] * r->dx + normal[1] * r->dy); /* of the disc */
    double sum = cosines_to(middle + r->angle) - cosines_to(middle - r->angle);
    if (!(sum > 0.0))
        return 0.0;
    dpl_cover cover;
    double sign = cover_disc(view, r, &cover, counts) ? -1.0 : 1.0;
    if (dpl_cover_is_full(&cover))
        return 0.0;
    for (int i = 0; i < cover.count; i++)
        sum -= sign * (cosines_to(middle + sign * atan(cover.high[i])) -
                       cosines_to(middle + sign * atan(cover.low[i])));
    return fmax(0.5 * sum, 0.0);
}
