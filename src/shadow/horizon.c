/* Makes a horizon, see horizon.h. */
#include "shadow/horizon.h"

#include "job/jobs.h"

static const double HALF_PI = 1.57079632679489661923;

/* A bin is narrower than a pixel at the far end of the picture, so a pixel that reaches into a bin is met by
 * the middle of it or of a neighbour, or something nearer is; and by this much at most that point is further
 * than the pixel's nearest [px]. */
#define PIXEL_REACH 1.5
/* A light is taken to be at least this large [px]: a harder shadow is decided by the methods. */
#define LEAST_RADIUS 1e-3

/* Arrays of one double per bin. */
typedef struct arrays {
    double *hit;   /* distance to what the bin's middle meets, INFINITY if nothing */
    double *raise; /* least a that makes a receiver in this bin lit: the envelope of tents */
    double *left;  /* per middle: least a0 at its own angle to be dark on the left side, within its stretch */
    double *right;
    uint8_t *linked; /* to the next bin */
} arrays;

typedef struct making {
    dpl_horizon *horizon;
    const dpl_solid *solid;
    double radius;
    double reach; /* no receiver is further [px] */
    arrays a;
} making;

/* Of numbers; fmin() and fmax() are calls, which cost as much as the rest of these loops. */
static inline double lesser(double a, double b) {
    return a < b ? a : b;
}

static inline double greater(double a, double b) {
    return a > b ? a : b;
}

static int32_t wrap(const making *m, int32_t bin) {
    return bin & (m->horizon->bin_count - 1);
}

/* ---- sizes ---------------------------------------------------------------------------------------- */

/* Distance from the light to the furthest corner of the picture. */
static double furthest_corner(const dpl_solid *solid, const double position[2]) {
    double x = greater(fabs(position[0]), fabs(position[0] - solid->width));
    double y = greater(fabs(position[1]), fabs(position[1] - solid->height));
    return sqrt(x * x + y * y);
}

/* Bins are widest in the middle of a side: 8 / count rad. For a light so far away that there would be too
 * many, 0: its horizon leaves every pixel open. */
static int32_t bins_for(double reach) {
    for (int32_t count = 256; count <= 1 << 18; count *= 2)
        if (count * 0.7 >= 8.0 * reach)
            return count;
    return 0;
}

static dpl_status leave_open(dpl_horizon *horizon, dpl_context *context) {
    DPL_TRY(dpl_buffer_reserve(context, &horizon->bins, 4, sizeof(dpl_horizon_bin)));
    memset(horizon->bins.data, 0, 4 * sizeof(dpl_horizon_bin));
    horizon->bin_count = 4;
    return DPL_OK;
}

static double angle_of(double position) {
    int side;
    double along = dpl_polar_tangent(position, &side);
    return (position >= 4.0 ? 4 : side) * HALF_PI + atan(along);
}

/* Unit directions of the bins' middles; they lie behind the angles. */
static double (*directions_of(const dpl_horizon *horizon))[2] {
    return (double(*)[2])((double *)horizon->angles.data + 2 * (size_t)horizon->bin_count + 2);
}

static void fill_angles(double *middles, int32_t count) {
    double *edges = middles + count, step = 4.0 / count;
    for (int32_t i = 0; i < count; i++) {
        middles[i] = angle_of((i + 0.5) * step);
        edges[i] = angle_of(i * step);
    }
    edges[count] = edges[0] + 4.0 * HALF_PI;
}

static dpl_status reserve(making *m, dpl_context *context, int32_t count) {
    dpl_horizon *h = m->horizon;
    size_t bins = (size_t)count;
    DPL_TRY(dpl_buffer_reserve(context, &h->bins, bins, sizeof(dpl_horizon_bin)));
    DPL_TRY(dpl_buffer_reserve(context, &h->work, bins, 4 * sizeof(double) + 1));
    if (h->bin_count != count) {
        h->bin_count = 0;
        DPL_TRY(dpl_buffer_reserve(context, &h->angles, 4 * bins + 2, sizeof(double)));
        fill_angles(h->angles.data, count);
        h->bin_count = count;
        for (int32_t i = 0; i < count; i++) {
            double *direction = directions_of(h)[i];
            dpl_polar_direction((i + 0.5) * 4.0 / count, &direction[0], &direction[1]);
        }
    }
    double *work = h->work.data;
    m->a = (arrays){work, work + bins, work + 2 * bins, work + 3 * bins, (uint8_t *)(work + 4 * bins)};
    return DPL_OK;
}

/* ---- what the light's centre sees ----------------------------------------------------------------- */

static void look(int32_t begin, int32_t end, int32_t worker, void *task) {
    (void)worker;
    const making *m = task;
    const double *position = m->horizon->position;
    for (int32_t i = begin; i < end; i++) {
        double dx, dy;
        dpl_polar_direction((i + 0.5) * 4.0 / m->horizon->bin_count, &dx, &dy);
        m->a.hit[i] = dpl_solid_first_hit(m->solid, position[0], position[1], dx, dy, m->reach);
    }
}

/* A square from (x, y) to (x + 1, y + 1), seen from outside it: what the middles of bins meet of it. */
static void draw_square(const making *m, double x, double y) {
    double(*direction)[2] = directions_of(m->horizon);
    double count = m->horizon->bin_count, first = INFINITY, last = -INFINITY;
    double middle = dpl_polar_from_direction(x + 0.5, y + 0.5);
    for (int k = 0; k < 4; k++) {
        double at = dpl_polar_from_direction(x + (k & 1), y + (k >> 1));
        at += at > middle + 2.0 ? -4.0 : at < middle - 2.0 ? 4.0 : 0.0;
        first = lesser(first, at);
        last = greater(last, at);
    }
    int32_t end = (int32_t)floor(last * 0.25 * count + 0.5);
    for (int32_t i = (int32_t)floor(first * 0.25 * count + 0.5); i < end; i++) {
        const double *d = direction[wrap(m, i)];
        double by_x = (d[0] > 0.0 ? x : x + 1.0) / d[0], by_y = (d[1] > 0.0 ? y : y + 1.0) / d[1];
        m->a.hit[wrap(m, i)] = lesser(m->a.hit[wrap(m, i)], greater(by_x, by_y));
    }
}

/* The same as looking along each bin's middle, from a light that is not in an opaque pixel or on its edge:
 * squares with a free side towards the light are drawn one by one, which are far fewer than a ray's steps. */
static void draw_hits(const making *m) {
    const double *position = m->horizon->position;
    for (int32_t i = 0; i < m->horizon->bin_count; i++)
        m->a.hit[i] = INFINITY;
    for (int32_t y = 0; y < m->solid->height; y++)
        for (int32_t word = 0; word * 64 < m->solid->width; word++) {
            uint64_t bits = dpl_solid_exposed(m->solid, y, word, position, 0.0);
            for (; bits; bits &= bits - 1)
                draw_square(m, word * 64 + dpl_lowest_bit(bits) - position[0], y - position[1]);
        }
}

/* Is any opaque pixel within a pixel of the light's centre? */
static bool is_touched(const making *m) {
    int32_t x = (int32_t)floor(m->horizon->position[0]), y = (int32_t)floor(m->horizon->position[1]);
    for (int32_t k = 0; k < 9; k++)
        if (dpl_solid_contains(m->solid, x - 1 + k % 3, y - 1 + k / 3))
            return true;
    return false;
}

static dpl_status find_hits(making *m, dpl_context *context) {
    if (is_touched(m))
        return dpl_jobs_run(context, look, m->horizon->bin_count, 64, m);
    draw_hits(m);
    return DPL_OK;
}

static double angle_covered(const making *m, double distance) {
    return distance > m->radius ? asin(m->radius / distance) : HALF_PI;
}

static double nearest_in(const making *m, int32_t bin) {
    const double *hit = m->a.hit;
    return lesser(hit[bin], lesser(hit[wrap(m, bin - 1)], hit[wrap(m, bin + 1)])) - PIXEL_REACH;
}

/* ---- lit ------------------------------------------------------------------------------------------ */

/* The envelope of tents, in two sweeps around the circle each way. `carry` is the envelope at the near edge
 * of bin i: a point anywhere in a bin may be as near to a receiver as the edge between them. */
static void raise_envelope(const making *m, const double *own) {
    const double *edge = (const double *)m->horizon->angles.data + m->horizon->bin_count;
    int32_t count = m->horizon->bin_count;
    for (int32_t i = 0; i < count; i++)
        m->a.raise[i] = own[i];
    for (int way = 1; way >= -1; way -= 2) {
        double carry = -INFINITY;
        for (int32_t k = 0; k < 2 * count; k++) {
            int32_t i = wrap(m, way * k);
            m->a.raise[i] = greater(m->a.raise[i], carry);
            carry = greater(own[i], carry - (edge[i + 1] - edge[i]));
        }
    }
}

static double distance_where(const making *m, double a) {
    return a <= 0.0 ? INFINITY : a >= HALF_PI ? m->radius : m->radius / sin(a);
}

/* ---- dark ----------------------------------------------------------------------------------------- */

/* Are the pixels that the middles of a bin and the next meet the same or neighbours, and clear of the disc?
 * Then nothing passes between the two points. */
static bool can_link(const making *m, int32_t bin) {
    const double *position = m->horizon->position, *hit = m->a.hit;
    double step = 4.0 / m->horizon->bin_count;
    int32_t bins[2] = {bin, wrap(m, bin + 1)}, x[2], y[2];
    for (int k = 0; k < 2; k++) {
        double dx, dy, at = hit[bins[k]] + 1e-3; /* just inside */
        if (!(hit[bins[k]] < INFINITY) || hit[bins[k]] < m->radius + 2.0 * PIXEL_REACH)
            return false;
        dpl_polar_direction((bins[k] + 0.5) * step, &dx, &dy);
        x[k] = (int32_t)floor(position[0] + at * dx);
        y[k] = (int32_t)floor(position[1] + at * dy);
        if (!dpl_solid_contains(m->solid, x[k], y[k]))
            return false;
    }
    return x[1] - x[0] <= 1 && x[0] - x[1] <= 1 && y[1] - y[0] <= 1 && y[0] - y[1] <= 1;
}

/* For each middle the least a0 that a receiver at its angle needs so that the stretch of points linked to it
 * reaches past one side of its triangle. INFINITY: not even linked to the next. */
static void reach_sideways(const making *m, int way, double *least) {
    const double *middle = m->horizon->angles.data;
    int32_t count = m->horizon->bin_count;
    for (int32_t i = 0; i < count; i++)
        least[i] = angle_covered(m, m->a.hit[i]);
    for (int32_t k = 0; k < 2 * count; k++) {
        int32_t i = wrap(m, -way * k), before = wrap(m, i + way);
        double apart = fabs(middle[i] - middle[before]);
        apart = lesser(apart, 4.0 * HALF_PI - apart);
        if (m->a.linked[way < 0 ? before : i])
            least[i] = lesser(least[i], least[before] - apart);
    }
}

static double angle_between(double from, double to) {
    double apart = fabs(to - from);
    return apart > 2.0 * HALF_PI ? fabs(4.0 * HALF_PI - apart) : apart;
}

/* A receiver in this bin has a middle to its left and one to its right, both linked to this bin's. */
static void find_dark(const making *m, int32_t i, dpl_horizon_bin *bin) {
    const double *middle = m->horizon->angles.data, *edge = middle + m->horizon->bin_count;
    int32_t left = wrap(m, i - 1), right = wrap(m, i + 1);
    bin->dark_from = INFINITY;
    bin->dark_to = 0.0f;
    if (!m->a.linked[left] || !m->a.linked[i])
        return;
    double least = greater(m->a.left[left] - angle_between(middle[left], edge[i]),
                           m->a.right[right] - angle_between(edge[i + 1], middle[right]));
    double from = greater(m->a.hit[i], greater(m->a.hit[left], m->a.hit[right])) + PIXEL_REACH;
    double to = distance_where(m, least);
    bin->dark_from = (float)(from * from);
    bin->dark_to = (float)(to * to);
}

/* ---- all ------------------------------------------------------------------------------------------ */

/* A direction on the edge between two bins may be rounded into either: each takes the stricter of its own
 * and its neighbours' thresholds. */
static void make_strict(const making *m, const dpl_horizon_bin *own, dpl_horizon_bin *strict) {
    for (int32_t i = 0; i < m->horizon->bin_count; i++) {
        strict[i] = own[i];
        for (int side = -1; side <= 1; side += 2) {
            const dpl_horizon_bin *next = &own[wrap(m, i + side)];
            strict[i].lit_to = fminf(strict[i].lit_to, next->lit_to);
            strict[i].dark_from = fmaxf(strict[i].dark_from, next->dark_from);
            strict[i].dark_to = fminf(strict[i].dark_to, next->dark_to);
        }
    }
}

dpl_status dpl_horizon_make(dpl_horizon *horizon, dpl_context *context, const dpl_solid *solid,
                            const double position[2], double radius) {
    making m = {.horizon = horizon, .solid = solid, .radius = greater(radius, LEAST_RADIUS)};
    m.reach = furthest_corner(solid, position);
    horizon->position[0] = position[0];
    horizon->position[1] = position[1];
    int32_t count = bins_for(m.reach);
    if (count == 0)
        return leave_open(horizon, context);
    DPL_TRY(reserve(&m, context, count));
    DPL_TRY(find_hits(&m, context));
    dpl_horizon_bin *bins = horizon->bins.data;
    for (int32_t i = 0; i < count; i++)
        m.a.linked[i] = can_link(&m, i);
    reach_sideways(&m, -1, m.a.left);
    reach_sideways(&m, 1, m.a.right);
    for (int32_t i = 0; i < count; i++)
        find_dark(&m, i, &bins[i]);
    double *own = m.a.left; /* no longer needed */
    for (int32_t i = 0; i < count; i++)
        own[i] = angle_covered(&m, nearest_in(&m, i));
    raise_envelope(&m, own);
    for (int32_t i = 0; i < count; i++) {
        double to = distance_where(&m, m.a.raise[i]);
        bins[i].lit_to = (float)(to * to * (1.0 - 1e-6));
    }
    /* The arrays of the work are larger than the bins. */
    dpl_horizon_bin *copy = (dpl_horizon_bin *)(void *)horizon->work.data;
    memcpy(copy, bins, (size_t)count * sizeof *bins);
    make_strict(&m, copy, bins);
    return DPL_OK;
}

void dpl_horizon_free(dpl_context *context, dpl_horizon *horizon) {
    dpl_buffer_free(context, &horizon->bins);
    dpl_buffer_free(context, &horizon->angles);
    dpl_buffer_free(context, &horizon->work);
}
