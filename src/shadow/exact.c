/* The exact method: the union of the angles that opaque pixels cover before the disc, seen from a receiver.
 * Works on the pixel world itself, so that it equals the truth for shapes, pictures and raw buffers alike.
 *
 * The triangle between the receiver and the disc is walked column by column (or row by row, along the longer
 * axis), 64 pixels of a column at a time as bits; the distance field jumps over what is empty. A run of
 * opaque pixels covers the slopes between two of its corners. Pixels near the disc or beside the receiver are
 * cut edge by edge. Slopes are tangents of angles from the line to the light's centre.
 *
 * Cost: columns that hold something, not shapes; a light's angle that is covered whole ends the walk. */
#include "shadow/cover.h"
#include "shadow/shadow.h"

#include <math.h>

#define HALF_DIAGONAL 0.7072
/* A jump must save this many columns to be worth its square root. */
#define WORTH_A_JUMP 2.0

/* The walk's own coordinates: u along, v across; bits of one u are a line. */
typedef struct walk {
    const dpl_shadow_view *view;
    dpl_shadow_counts *counts;
    dpl_cover *cover;
    bool is_turned; /* u is y */
    const uint64_t *lines;
    int32_t line_words, u_size, v_size;
    double u, v;       /* receiver */
    double au, av;     /* unit direction to the light's centre */
    double distance;   /* to it */
    double tangent;    /* of half the light's angle */
    double low, high;  /* slopes v / |u| of the triangle's sides */
    int32_t step;      /* -1 or 1: which way u goes */
    double axis;       /* slope of the line to the centre */
    double light_u;    /* of the light's centre */
    int32_t columns;   /* left to walk */
    bool is_wide;      /* a side of the triangle runs against u: take its whole box */
    double box_low, box_high;
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
    if (value_a <= 0.0 && value_b <= 0.0)
        return;
    double t = value_a / (value_a - value_b);
    if (value_a > 0.0 && value_b > 0.0)
        *to = -1.0;
    else if (value_a > 0.0)
        *from = fmax(*from, t);
    else
        *to = fmin(*to, t);
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

/* ---- columns -------------------------------------------------------------------------------------- */

/* A run of opaque pixels first .. end-1, whose sides are `near` and `far` from the receiver along u. */
static void add_run(walk *w, int32_t column, int32_t first, int32_t end, double near, double far,
                    bool careful) {
    if (careful) {
        for (int32_t v = first; v < end; v++)
            add_square(w, column, v);
        return;
    }
    double low = first - w->v, high = end - w->v;
    double low_u = w->step * (low < 0.0 ? near : far), high_u = w->step * (high > 0.0 ? near : far);
    double s0 = (low * w->au - low_u * w->av) / (low_u * w->au + low * w->av);
    double s1 = (high * w->au - high_u * w->av) / (high_u * w->au + high * w->av);
    dpl_cover_add(w->cover, fmin(s0, s1), fmax(s0, s1));
}

/* Adds the runs of one column between two pixels, both included. */
static void add_column(walk *w, int32_t column, int32_t first, int32_t last, double near, double far,
                       bool careful) {
    const uint64_t *line = w->lines + (size_t)column * (size_t)w->line_words;
    for (int32_t base = first; base <= last; base += 64) {
        uint64_t bits = dpl_solid_window(line, base);
        if (last - base < 63)
            bits &= ((uint64_t)2 << (last - base)) - 1;
        w->counts->fetches++;
        while (bits) {
            int32_t begin = dpl_lowest_bit(bits);
            uint64_t clear = ~bits & ~(uint64_t)0 << begin;
            int32_t end = clear ? dpl_lowest_bit(clear) : 64;
            add_run(w, column, base + begin, base + end, near, far, careful);
            bits &= end < 64 ? ~(uint64_t)0 << end : 0;
        }
    }
}

/* Columns that the distance at the middle of the triangle's near side proves empty. */
static int32_t columns_to_jump(walk *w, int32_t column, double near) {
    double v = w->v + near * w->axis;
    int32_t row = (int32_t)v;
    if (!(v >= 0.0) || row >= w->v_size)
        return 0;
    size_t cell = w->is_turned ? (size_t)column * (size_t)w->view->solid->width + (size_t)row
                               : (size_t)row * (size_t)w->view->solid->width + (size_t)column;
    w->counts->fetches++;
    double clear = (double)((const float *)w->view->solid->distance.data)[cell] - HALF_DIAGONAL;
    double half = near * fmax(w->high - w->axis, w->axis - w->low);
    if (clear < half + WORTH_A_JUMP)
        return 0;
    double widen = fmax(fabs(w->high), fabs(w->low)), square = 1.0 + widen * widen;
    return (int32_t)((sqrt(clear * clear * square - half * half) - widen * half) / square);
}

static void walk_columns(walk *w) {
    int32_t column = (int32_t)floor(w->is_wide ? w->box_low : w->u), own = (int32_t)floor(w->u);
    int32_t step = w->is_wide ? 1 : w->step;
    for (int32_t left = w->columns; left > 0 && !dpl_cover_is_full(w->cover); left--, column += step) {
        if (column < 0 || column >= w->u_size)
            break;
        double near = step * ((step > 0 ? column : column + 1) - w->u), far = near + 1.0;
        bool careful = w->is_wide || column == own || w->step * w->light_u - w->step * w->u - far < w->view->radius;
        double low = w->is_wide ? w->low : w->v + fmin(w->low * fmax(near, 0.0), w->low * far);
        double high = w->is_wide ? w->high : w->v + fmax(w->high * fmax(near, 0.0), w->high * far);
        w->counts->steps++;
        if (high < 0.0 || low >= w->v_size)
            continue;
        if (!careful) {
            int32_t jump = columns_to_jump(w, column, near);
            if (jump > 1) {
                column += step * (jump - 1);
                left -= jump - 1;
                continue;
            }
        }
        int32_t first = low > 0.0 ? (int32_t)low : 0;
        int32_t last = high < w->v_size ? (int32_t)high : w->v_size - 1;
        add_column(w, column, first, last, near, far, careful);
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
        w->axis = w->av / (w->step * w->au);
        double reach = fmax(w->step * end_u[0], w->step * end_u[1]);
        w->columns = (int32_t)fmin(reach + 2.0, 4.0 * DPL_MAX_SIZE);
        return;
    }
    w->box_low = w->u + fmin(0.0, fmin(end_u[0], end_u[1]));
    w->box_high = w->u + fmax(0.0, fmax(end_u[0], end_u[1]));
    w->low = w->v + tangent_length * fmin(0.0, fmin(side_v[0], side_v[1]));
    w->high = w->v + tangent_length * fmax(0.0, fmax(side_v[0], side_v[1]));
    w->box_low = fmax(w->box_low, 0.0);
    w->columns = (int32_t)fmin(floor(w->box_high) - floor(w->box_low) + 1.0, w->u_size);
}

static walk start_walk(const dpl_shadow_view *view, const dpl_receiver *r, dpl_cover *cover,
                       dpl_shadow_counts *counts) {
    const dpl_solid *solid = view->solid;
    bool turned = fabs(r->dy) > fabs(r->dx);
    walk w = {.view = view, .counts = counts, .is_turned = turned};
    w.lines = turned ? solid->rows.data : solid->columns.data;
    w.line_words = turned ? solid->row_words : solid->column_words;
    w.u_size = turned ? solid->height : solid->width;
    w.v_size = turned ? solid->width : solid->height;
    w.u = turned ? r->y : r->x;
    w.v = turned ? r->x : r->y;
    w.au = turned ? r->dy : r->dx;
    w.av = turned ? r->dx : r->dy;
    w.step = w.au > 0.0 ? 1 : -1;
    w.light_u = w.u + w.au * r->distance;
    w.distance = r->distance;
    w.tangent = r->sine / sqrt(1.0 - r->sine * r->sine);
    cover->limit = w.tangent;
    cover->count = 0;
    w.cover = cover;
    lay_out(&w, r->sine);
    return w;
}

double dpl_shadow_exact(const dpl_shadow_view *view, const dpl_receiver *r, dpl_shadow_counts *counts) {
    if (!(view->radius > 0.0))
        return dpl_solid_first_hit(view->solid, r->x, r->y, r->dx, r->dy, r->distance) < INFINITY ? 0.0 : 1.0;
    dpl_cover cover; /* large, and only its first entries are ever touched */
    walk w = start_walk(view, r, &cover, counts);
    walk_columns(&w);
    if (dpl_cover_is_full(&cover))
        return 0.0;
    double covered = 0.0;
    for (int i = 0; i < cover.count; i++)
        covered += atan(cover.high[i]) - atan(cover.low[i]);
    return fmax(1.0 - 0.5 * covered / r->angle, 0.0);
}
