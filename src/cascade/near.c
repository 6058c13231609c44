/* Rays of a row of probes against a box: by two divisions, for all of them. */
#include "cascade/near.h"

#include "cascade/aim.h"

float dpl_march_margin(const dpl_schedule_level *plan, int32_t width, int32_t height) {
    double size = plan->t0 + plan->spacing + width + height;
    return (float)(1.0 / 16.0 + 1e-6 * size);
}

/* fmin() and fmax() are calls where compilers must mind not-a-number; and floor() is one where there is no
 * instruction for it. */
static inline double lesser(double a, double b) {
    return a < b ? a : b;
}

static inline double greater(double a, double b) {
    return a > b ? a : b;
}

/* A coordinate c + d t for t in [from, to] stays within [low, high] for the t that are left. */
static void clip(double c, double d, double low, double high, double *from, double *to) {
    double a = (low - c) / d, b = (high - c) / d;
    if (d == 0.0) {
        if (c < low || c > high)
            *to = *from - 1.0;
        return;
    }
    *from = greater(*from, lesser(a, b));
    *to = lesser(*to, greater(a, b));
}

/* Rounded down. */
static int32_t probe_number(double number, int32_t count) {
    return number <= 0.0 ? 0 : number >= count ? count : (int32_t)number;
}

/* The rays are one segment moved along x, so those that come near are neighbours. */
void dpl_rays_near(const dpl_schedule_level *plan, const float direction[2], int32_t row,
                   const dpl_ray_box *box, double slack, int32_t *first, int32_t *last) {
    double from = plan->t0, to = plan->t1;
    clip(dpl_probe_position(plan, row), direction[1], box->y0 - slack, box->y1 + slack, &from, &to);
    *first = *last = 0;
    if (from > to || box->x0 > box->x1)
        return;
    double a = from * direction[0], b = to * direction[0], spacing = plan->spacing;
    *first = probe_number((box->x0 - slack - greater(a, b)) / spacing - 0.5, plan->probes_x);
    *last = probe_number((box->x1 + slack - lesser(a, b)) / spacing + 1.5, plan->probes_x);
}
