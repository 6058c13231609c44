/* Moments of depth, see moments.h. Formulas with their sources: docs/algorithms/mrma.md. */
#include "shadow/moments.h"

#include <math.h>

static const double SQRT3 = 1.73205080756887729353;

static double clamp_unit(double v) {
    return v > 0.0 ? v < 1.0 ? v : 1.0 : 0.0;
}

/* ---- two moments ---------------------------------------------------------------------------------- */

double dpl_moments_cantelli(double mean, double mean_square, double depth, double least_variance) {
    if (!(depth > mean))
        return 1.0;
    double variance = fmax(mean_square - mean * mean, least_variance);
    double beyond = depth - mean;
    double sum = variance + beyond * beyond;
    return sum > 0.0 ? variance / sum : 0.0;
}

double dpl_moments_reduce_bleeding(double visibility, double amount) {
    return clamp_unit((visibility - amount) / (1.0 - amount));
}

void dpl_moments_warp(double z, double sharpness, double warped[4]) {
    double up = exp(sharpness * z), down = -exp(-sharpness * z);
    warped[0] = up;
    warped[1] = up * up;
    warped[2] = down;
    warped[3] = down * down;
}

double dpl_moments_warped_visibility(const double warped[4], double depth, double sharpness, double bias) {
    double at[4];
    dpl_moments_warp(depth, sharpness, at);
    /* A small depth difference becomes one of sharpness * |warp| times that. */
    double least_up = sharpness * at[0] * bias, least_down = sharpness * at[2] * bias;
    double up = dpl_moments_cantelli(warped[0], warped[1], at[0], least_up * least_up);
    double down = dpl_moments_cantelli(warped[2], warped[3], at[2], least_down * least_down);
    return fmin(up, down);
}

/* ---- four moments --------------------------------------------------------------------------------- */

void dpl_moments_of(double z, double b[4]) {
    double square = z * z;
    b[0] = z;
    b[1] = square;
    b[2] = square * z;
    b[3] = square * square;
}

void dpl_moments_add_bias(double b[4], double bias, double target) {
    for (int i = 0; i < 4; i++)
        b[i] = (1.0 - bias) * b[i] + (i % 2 ? bias * target : 0.0);
}

/* Solves the Hankel matrix of the moments times c = (1, z, z^2) by its LDL^T factors. The roots of
 * c[0] + c[1] z + c[2] z^2 are the other two points. */
static bool solve_hankel(const double b[4], double z, double c[3]) {
    double d1 = b[1] - b[0] * b[0];
    double l21_d1 = b[2] - b[0] * b[1];
    if (!(d1 > 0.0))
        return false;
    double l21 = l21_d1 / d1;
    double d2 = b[3] - b[1] * b[1] - l21_d1 * l21;
    if (!(d2 > 0.0))
        return false;
    double y1 = z - b[0];
    double y2 = z * z - b[1] - l21 * y1;
    c[2] = y2 / d2;
    c[1] = y1 / d1 - l21 * c[2];
    c[0] = 1.0 - b[0] * c[1] - b[1] * c[2];
    return true;
}

/* One point besides `depth`: the third is at infinity with weight 0. */
static void solve_two_points(const double b[4], double depth, double root, dpl_moments_points *p) {
    p->z[0] = p->z[2] = depth;
    p->z[1] = root;
    p->weight[1] = (b[0] - depth) / (root - depth);
    p->weight[0] = 1.0 - p->weight[1];
    p->weight[2] = 0.0;
}

bool dpl_moments_solve(const double b[4], double depth, dpl_moments_points *p) {
    double c[3];
    if (!solve_hankel(b, depth, c))
        return false;
    double discriminant = c[1] * c[1] - 4.0 * c[0] * c[2];
    double q = -0.5 * (c[1] + copysign(sqrt(fmax(discriminant, 0.0)), c[1]));
    if (q == 0.0)
        return false;
    double near = c[0] / q, far = q / c[2];
    if (!(fabs(far) < 1e9)) { /* c[2] vanishes for two depths, and then the quadratic is linear */
        solve_two_points(b, depth, near, p);
        return isfinite(p->weight[1]);
    }
    double z[3] = {depth, fmin(near, far), fmax(near, far)};
    for (int i = 0; i < 3; i++) {
        double other = z[(i + 1) % 3], third = z[(i + 2) % 3];
        p->z[i] = z[i];
        p->weight[i] = (other * third - b[0] * (other + third) + b[1]) / ((z[i] - other) * (z[i] - third));
        if (!isfinite(p->weight[i]))
            return false;
    }
    return true;
}

/* Weight of the points before the receiver, and their weighted depths. */
static double before(const dpl_moments_points *p, double *weighted) {
    double share = 0.0;
    *weighted = 0.0;
    for (int i = 1; i < 3; i++)
        if (p->z[i] < p->z[0]) {
            share += p->weight[i];
            *weighted += p->weight[i] * p->z[i];
        }
    return share;
}

double dpl_moments_visibility(const double b[4], double depth) {
    dpl_moments_points points;
    double weighted;
    if (!dpl_moments_solve(b, depth, &points))
        return dpl_moments_cantelli(b[0], b[1], depth, DPL_MOMENTS_LEAST_VARIANCE);
    return clamp_unit(1.0 - before(&points, &weighted));
}

double dpl_moments_blocker(const double b[4], double depth, double *share) {
    /* As if this much of the receiver itself were before it: no division by 0. */
    static const double OF_ITSELF = 1e-3;
    dpl_moments_points points;
    double weighted;
    *share = 0.0;
    if (!dpl_moments_solve(b, depth, &points))
        return depth;
    double sum = before(&points, &weighted);
    *share = clamp_unit(sum);
    return (OF_ITSELF * depth + weighted) / (OF_ITSELF + sum);
}

/* ---- packing -------------------------------------------------------------------------------------- */

void dpl_moments_pack(const double b[4], double packed[4]) {
    packed[0] = 1.5 * b[0] - 2.0 * b[2] + 0.5;
    packed[1] = 4.0 * (b[1] - b[3]);
    packed[2] = 0.5 * SQRT3 * b[0] - 2.0 / 9.0 * SQRT3 * b[2] + 0.5;
    packed[3] = 0.5 * (b[1] + b[3]);
}

void dpl_moments_unpack(const double packed[4], double b[4]) {
    double x = packed[0] - 0.5, y = packed[2] - 0.5;
    b[0] = -x / 3.0 + SQRT3 * y;
    b[1] = 0.125 * packed[1] + packed[3];
    b[2] = -0.75 * x + 0.75 * SQRT3 * y;
    b[3] = -0.125 * packed[1] + packed[3];
}

void dpl_moments_pack_16(const double b[4], uint16_t packed[4]) {
    double exact[4];
    dpl_moments_pack(b, exact);
    for (int i = 0; i < 4; i++)
        packed[i] = (uint16_t)(clamp_unit(exact[i]) * 65535.0 + 0.5);
}

void dpl_moments_unpack_16(const uint16_t packed[4], double b[4]) {
    double exact[4];
    for (int i = 0; i < 4; i++)
        exact[i] = packed[i] / 65535.0;
    dpl_moments_unpack(exact, b);
}
