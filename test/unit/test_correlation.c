/* Correlation against values computed elsewhere: r by another program, the interval by its formula, p by
 * numeric integration of Student's density, or in closed form where there is one. */
#include "testing.h"

#include <dapple/correlation.h>

#include <float.h>
#include <math.h>
#include <string.h>

enum { LONGEST = 2000 };

static const double PI = 3.14159265358979323846;

static void assert_near(double value, double expected, double tolerance) {
    assert_true(fabs(value - expected) <= tolerance);
}

static dpl_correlation correlate(const double *x, const double *y, int32_t count) {
    dpl_correlation c;
    assert_ok(dpl_correlate(x, y, count, &c));
    assert_int_equal(c.count, count);
    return c;
}

/* Two series with a given r: a cosine, and the same turned by acos(r). */
static dpl_correlation correlate_with_r(double r, int32_t count) {
    static double x[LONGEST], y[LONGEST];
    for (int32_t i = 0; i < count; i++) {
        const double angle = 2.0 * PI * i / count;
        x[i] = 3.0 + cos(angle);
        y[i] = 40.0 + 7.0 * (r * cos(angle) + sqrt(1.0 - r * r) * sin(angle));
    }
    const dpl_correlation c = correlate(x, y, count);
    assert_near(c.r, r, 1e-13);
    return c;
}

static void small_series_give_the_values_of_another_program(void **state) {
    (void)state;
    static const struct {
        double x[12], y[12];
        dpl_correlation expected;
    } cases[] = {
        {{1, 2, 4}, {3, 1, 2}, {-0.327326835353989, -1.0, 1.0, 0.787704384990342, 3}},
        {{1, 2, 4, 7},
         {2, 1, 5, 3},
         {0.479512223816156, -0.893216254966649, 0.986135704836731, 0.520487776183844, 4}},
        {{2, 4, 4, 5, 7, 8, 11},
         {1.5, 3, 2.25, 6, 4, 9, 7.5},
         {0.816812533842264, 0.165642065923676, 0.971991546025799, 0.0249279095794635, 7}},
        {{0.1, -2, 3.5, 0.25, 7, -1.5, 4, 4, 9, 2},
         {5, 3, -1, 4.5, -2, 6, 0, 1, -3.25, 2},
         {-0.919360222976801, -0.98108320084577, -0.68796448724532, 0.000167693937521187, 10}},
        {{1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12},
         {3, 1, 4, 1, 5, 9, 2, 6, 5, 3, 5, 8},
         {0.497387289060189, -0.107080649688851, 0.833395127607593, 0.0999032160559123, 12}},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        const dpl_correlation c = correlate(cases[i].x, cases[i].y, cases[i].expected.count);
        assert_near(c.r, cases[i].expected.r, 1e-13);
        assert_near(c.low, cases[i].expected.low, 1e-13);
        assert_near(c.high, cases[i].expected.high, 1e-13);
        assert_near(c.p / cases[i].expected.p, 1.0, 1e-11);
    }
}

static void p_is_the_integral_of_students_density(void **state) {
    (void)state;
    static const struct {
        int32_t count;
        double r, p;
    } cases[] = {
        {50, -0.68, 5.59732920052445e-08}, {50, 0.73, 1.79578227001175e-09},
        {50, 0.81, 1.04833676786049e-12},  {50, 0.20, 0.163753081245418},
        {50, -0.60, 4.12021593097769e-06}, {600, 0.05, 0.221346359985529},
        {5, 0.9, 0.0373860734684986},      {2000, 0.01, 0.654914641036551},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        assert_near(correlate_with_r(cases[i].r, cases[i].count).p / cases[i].p, 1.0, 1e-9);
        assert_near(correlate_with_r(-cases[i].r, cases[i].count).p / cases[i].p, 1.0, 1e-9);
    }
}

static double rounded(double value) {
    return round(100.0 * value) / 100.0;
}

/* The paper prints r with two digits: some r that rounds to it has the interval that the paper prints. */
static void intervals_of_50_scenes_are_the_papers(void **state) {
    (void)state;
    static const struct {
        double r, printed, low, high;
    } rows[] = {
        {0.81, 0.81, 0.69, 0.89},     {0.766, 0.77, 0.62, 0.86}, {0.727, 0.73, 0.56, 0.84},
        {0.686, 0.69, 0.50, 0.81},    {0.20, 0.20, -0.08, 0.45}, {-0.60, -0.60, -0.75, -0.39},
        {-0.68, -0.68, -0.81, -0.50},
    };
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        const dpl_correlation c = correlate_with_r(rows[i].r, 50);
        assert_near(rounded(c.r), rows[i].printed, 1e-9);
        assert_near(rounded(c.low), rows[i].low, 1e-9);
        assert_near(rounded(c.high), rows[i].high, 1e-9);
        assert_true((c.p < 0.05) == (rows[i].low > 0.0 || rows[i].high < 0.0));
    }
}

/* n = 4 has p = 1 - |r|, n = 6 has p = 1 - |r| (3 - r^2) / 2. */
static void p_of_4_and_6_values_is_in_closed_form(void **state) {
    (void)state;
    for (int i = -99; i <= 99; i++) {
        const double r = 0.01 * i, size = fabs(r);
        assert_near(correlate_with_r(r, 4).p, 1.0 - size, 1e-13);
        assert_near(correlate_with_r(r, 6).p, 1.0 - 0.5 * size * (3.0 - r * r), 1e-13);
    }
}

/* n = 3: p = 1 - 2/pi asin |r|. */
static void three_values_have_a_p_but_no_interval(void **state) {
    (void)state;
    for (int i = -99; i <= 99; i++) {
        const dpl_correlation c = correlate_with_r(0.01 * i, 3);
        assert_near(c.p, 1.0 - 2.0 / PI * asin(fabs(0.01 * i)), 1e-12);
        assert_true(c.low == -1.0 && c.high == 1.0);
    }
}

static void two_values_say_nothing(void **state) {
    (void)state;
    const double x[2] = {1, 3}, y[2] = {5, 9};
    const dpl_correlation c = correlate(x, y, 2), mirrored = correlate(x, (const double[2]){9, 5}, 2);
    assert_true(c.r == 1.0 && mirrored.r == -1.0);
    assert_true(c.low == -1.0 && c.high == 1.0 && c.p == 1.0);
    assert_true(mirrored.low == -1.0 && mirrored.high == 1.0 && mirrored.p == 1.0);
}

static void a_straight_line_is_certain(void **state) {
    (void)state;
    double x[16], up[16], down[16];
    for (int i = 0; i < 16; i++) {
        x[i] = i;
        up[i] = 2.0 * i + 1.0;
        down[i] = 5.0 - 4.0 * i;
    }
    for (int32_t n = 4; n <= 16; n++) {
        const dpl_correlation rising = correlate(x, up, n), falling = correlate(x, down, n);
        assert_true(rising.r == 1.0 && rising.low == 1.0 && rising.high == 1.0 && rising.p == 0.0);
        assert_true(falling.r == -1.0 && falling.low == -1.0 && falling.high == -1.0 && falling.p == 0.0);
    }
}

/* Steps of one rounding each: a mean that is itself rounded would bend the line. */
static void a_line_as_flat_as_doubles_can_be_is_still_a_line(void **state) {
    (void)state;
    double x[7], y[7];
    for (int i = 0; i < 7; i++) {
        x[i] = i;
        y[i] = 1.0 + i * DBL_EPSILON;
    }
    assert_near(correlate(x, y, 7).r, 1.0, 1e-15);
}

static void a_constant_series_has_r_0_and_p_1(void **state) {
    (void)state;
    double constant[50], rising[50];
    for (int i = 0; i < 50; i++) {
        constant[i] = 0.1; /* whose mean is rounded when it is summed */
        rising[i] = i;
    }
    for (int32_t n = 2; n <= 50; n++) {
        const dpl_correlation one = correlate(constant, rising, n), both = correlate(constant, constant, n);
        const dpl_correlation other = correlate(rising, constant, n);
        const double high = n < 4 ? 1.0 : tanh(1.959964 / sqrt(n - 3));
        assert_true(one.r == 0.0 && one.p == 1.0 && other.r == 0.0 && other.p == 1.0);
        assert_true(both.r == 0.0 && both.p == 1.0);
        assert_near(one.high, high, 1e-15);
        assert_near(one.low, -high, 1e-15);
    }
}

static void uncorrelated_series_have_p_1(void **state) {
    (void)state;
    const double x[4] = {-1, 1, -1, 1}, y[4] = {-1, -1, 1, 1};
    const dpl_correlation c = correlate(x, y, 4);
    assert_true(c.r == 0.0 && c.p == 1.0 && c.low == -c.high);
}

static void scale_offset_and_order_of_the_series_do_not_matter(void **state) {
    (void)state;
    const double x[7] = {2, 4, 4, 5, 7, 8, 11}, y[7] = {1.5, 3, 2.25, 6, 4, 9, 7.5};
    const double scales[] = {0x1p-600, 0x1p600, 0x1p1019, -0x1p-1000};
    const dpl_correlation plain = correlate(x, y, 7);
    assert_true(correlate(y, x, 7).r == plain.r);
    for (size_t i = 0; i < sizeof scales / sizeof scales[0]; i++) {
        double scaled[7], moved[7];
        for (int j = 0; j < 7; j++) {
            scaled[j] = x[j] * scales[i];
            moved[j] = y[j] + 1e6;
        }
        const double sign = scales[i] < 0.0 ? -1.0 : 1.0;
        assert_near(correlate(scaled, y, 7).r, sign * plain.r, 1e-15);
        assert_near(correlate(scaled, moved, 7).r, sign * plain.r, 1e-9);
    }
}

static void no_finite_series_gives_nan(void **state) {
    (void)state;
    const double extreme[] = {DBL_MAX, -DBL_MAX, DBL_MIN, 5e-324, 0.0, 1.0};
    const double y[4] = {1, 2, 4, DBL_MAX};
    for (int code = 0; code < 6 * 6 * 6 * 6; code++) {
        const double x[4] = {extreme[code % 6], extreme[code / 6 % 6], extreme[code / 36 % 6],
                             extreme[code / 216]};
        for (int32_t n = 2; n <= 4; n++) {
            const dpl_correlation c = correlate(x, y, n);
            assert_true(c.r >= -1.0 && c.r <= 1.0 && c.low >= -1.0 && c.low <= c.high && c.high <= 1.0);
            assert_true(c.p >= 0.0 && c.p <= 1.0);
        }
    }
}

static void bad_arguments_are_refused_and_nothing_is_written(void **state) {
    (void)state;
    const double bad[] = {(double)NAN, (double)INFINITY, -(double)INFINITY};
    const double x[3] = {1, 2, 3};
    dpl_correlation c, before;
    memset(&c, 7, sizeof c);
    memcpy(&before, &c, sizeof before);
    assert_int_equal(dpl_correlate(NULL, x, 3, &c), DPL_ERROR_ARGUMENT);
    assert_int_equal(dpl_correlate(x, NULL, 3, &c), DPL_ERROR_ARGUMENT);
    assert_int_equal(dpl_correlate(x, x, 3, NULL), DPL_ERROR_ARGUMENT);
    for (int32_t n = -1; n < 2; n++)
        assert_int_equal(dpl_correlate(x, x, n, &c), DPL_ERROR_ARGUMENT);
    for (int i = 0; i < 9; i++) {
        double broken[3] = {1, 2, 3};
        broken[i / 3] = bad[i % 3];
        assert_int_equal(dpl_correlate(broken, x, 3, &c), DPL_ERROR_ARGUMENT);
        assert_int_equal(dpl_correlate(x, broken, 3, &c), DPL_ERROR_ARGUMENT);
    }
    assert_memory_equal(&c, &before, sizeof before);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(small_series_give_the_values_of_another_program),
        cmocka_unit_test(p_is_the_integral_of_students_density),
        cmocka_unit_test(intervals_of_50_scenes_are_the_papers),
        cmocka_unit_test(p_of_4_and_6_values_is_in_closed_form),
        cmocka_unit_test(three_values_have_a_p_but_no_interval),
        cmocka_unit_test(two_values_say_nothing),
        cmocka_unit_test(a_straight_line_is_certain),
        cmocka_unit_test(a_line_as_flat_as_doubles_can_be_is_still_a_line),
        cmocka_unit_test(a_constant_series_has_r_0_and_p_1),
        cmocka_unit_test(uncorrelated_series_have_p_1),
        cmocka_unit_test(scale_offset_and_order_of_the_series_do_not_matter),
        cmocka_unit_test(no_finite_series_gives_nan),
        cmocka_unit_test(bad_arguments_are_refused_and_nothing_is_written),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
