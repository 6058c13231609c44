/* Pearson's correlation with its confidence interval and p-value. Called by studies through the public
 * header.
 *
 * Sources: Fisher, "On the probable error of a coefficient of correlation deduced from a small sample", 1921
 * (the interval); Abramowitz and Stegun, "Handbook of Mathematical Functions", 26.5.8 and 26.7.1 (the
 * continued fraction of the incomplete beta function, and Student's t by it). */
#include <dapple/correlation.h>

#include <math.h>
#include <stdbool.h>
#include <stddef.h>

static const double PI = 3.14159265358979323846;

#define NORMAL_QUANTILE 1.959964 /* of 97.5 % */

/* ---- r -------------------------------------------------------------------------------------------- */

/* A series minus its mean, times a power of two that keeps squares from overflowing. */
typedef struct series {
    const double *values;
    double scale;
    double first; /* scaled; the mean is counted from it, so a large offset costs no digits */
    double mean;  /* of what is left */
} series;

static double deviation(const series *s, int32_t i) {
    return s->values[i] * s->scale - s->first - s->mean;
}

static bool all_finite(const double *values, int32_t count) {
    for (int32_t i = 0; i < count; i++)
        if (!isfinite(values[i]))
            return false;
    return true;
}

static double scale_for(const double *values, int32_t count) {
    double largest = 0.0;
    for (int32_t i = 0; i < count; i++)
        largest = fmax(largest, fabs(values[i]));
    int exponent = 0;
    (void)frexp(largest, &exponent);
    const int limit = 1000; /* beyond, a power of two has no normal inverse */
    return ldexp(1.0, exponent > limit ? -limit : exponent < -limit ? limit : -exponent);
}

static series center(const double *values, int32_t count) {
    series s = {.values = values, .scale = scale_for(values, count)};
    s.first = values[0] * s.scale;
    double sum = 0.0;
    for (int32_t i = 0; i < count; i++)
        sum += deviation(&s, i);
    s.mean = sum / count;
    return s;
}

static bool is_constant(const double *values, int32_t count) {
    for (int32_t i = 1; i < count; i++)
        if (values[i] != values[0])
            return false;
    return true;
}

static double pearson(const double *x, const double *y, int32_t count) {
    const series sx = center(x, count), sy = center(y, count);
    double xx = 0.0, yy = 0.0, xy = 0.0;
    for (int32_t i = 0; i < count; i++) {
        const double dx = deviation(&sx, i), dy = deviation(&sy, i);
        xx += dx * dx;
        yy += dy * dy;
        xy += dx * dy;
    }
    return fmin(fmax(xy / sqrt(xx * yy), -1.0), 1.0);
}

/* ---- p -------------------------------------------------------------------------------------------- */

/* Arguments of the regularised incomplete beta function. y is 1 - x, kept by itself because the difference of
 * the two would lose the digits of a small y. */
typedef struct beta_point {
    double x, y, a, b;
} beta_point;

/* Terms of the continued fraction, from the last to the first, for x < (a+1) / (a+b+2): there every
 * denominator stays positive. The number of terms that matter grows with sqrt(max(a, b)). */
static double beta_fraction(beta_point at) {
    const int32_t pairs = 64 + (int32_t)(4.0 * sqrt(fmax(at.a, at.b)));
    double value = 1.0;
    for (int32_t m = pairs; m >= 1; m--) {
        const double above = at.a + 2.0 * m;
        const double even = m * (at.b - m) * at.x / ((above - 1.0) * above);
        const double odd =
            -(at.a + m - 1.0) * (at.a + at.b + m - 1.0) * at.x / ((above - 2.0) * (above - 1.0));
        value = 1.0 + odd / (1.0 + even / value);
    }
    return 1.0 / value;
}

/* 1 / B(freedom / 2, 1 / 2), from B(1/2, 1/2) = pi or B(1, 1/2) = 2 upwards in steps of 1. Not by lgamma(),
 * which writes a global in some C libraries. */
static double inverse_beta_of_half(int32_t freedom) {
    double inverse = freedom % 2 != 0 ? 1.0 / PI : 0.5;
    for (int32_t f = freedom % 2 != 0 ? 1 : 2; f < freedom - 1; f += 2)
        inverse *= (f + 1.0) / f;
    return inverse;
}

/* Two-sided p-value of r = 0: t^2 = freedom r^2 / (1 - r^2) makes it I(1 - r^2; freedom / 2, 1 / 2). */
static double p_value(double r, int32_t freedom) {
    const beta_point at = {.x = (1.0 - r) * (1.0 + r), .y = r * r, .a = 0.5 * freedom, .b = 0.5};
    const double front = pow(at.x, at.a) * sqrt(at.y) * inverse_beta_of_half(freedom);
    if (at.x < (at.a + 1.0) / (at.a + at.b + 2.0))
        return fmin(front / at.a * beta_fraction(at), 1.0);
    const beta_point mirrored = {.x = at.y, .y = at.x, .a = at.b, .b = at.a};
    return fmax(1.0 - front / mirrored.a * beta_fraction(mirrored), 0.0);
}

dpl_status dpl_correlate(const double *x, const double *y, int32_t count, dpl_correlation *result) {
    if (!x || !y || count < 2 || !result || !all_finite(x, count) || !all_finite(y, count))
        return DPL_ERROR_ARGUMENT;
    const bool constant = is_constant(x, count) || is_constant(y, count);
    dpl_correlation found = {.r = 0.0, .low = -1.0, .high = 1.0, .p = 1.0, .count = count};
    if (!constant)
        found.r = pearson(x, y, count);
    if (!constant && count >= 3)
        found.p = p_value(found.r, count - 2);
    if (count >= 4) {
        /* r = 1 and r = -1 pass through infinity and come back as they are. */
        const double z = atanh(found.r), reach = NORMAL_QUANTILE / sqrt(count - 3);
        found.low = tanh(z - reach);
        found.high = tanh(z + reach);
    }
    *result = found;
    return DPL_OK;
}
