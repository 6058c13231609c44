/* Signals of rings whose answers are known in closed form, and of random rings against a slow spectrum. */
#include "testing.h"

#include <dapple/signal.h>

#include <float.h>
#include <math.h>
#include <string.h>

enum { LARGEST = 4096 };

static const double PI = 3.14159265358979323846;

static const int32_t sizes[] = {1, 2, 3, 7, 16, 64};
enum { SIZES = sizeof sizes / sizeof sizes[0] };

static int32_t bins_of(int32_t count) {
    return (count + 1) / 2;
}

static dpl_signals signals_of(const double *samples, int32_t count) {
    dpl_signals signals;
    assert_ok(dpl_signals_of_ring(samples, count, &signals));
    return signals;
}

static void assert_near(double value, double expected) {
    assert_true(fabs(value - expected) <= 1e-12 * fmax(1.0, fabs(expected)));
}

static void a_black_ring_gives_0_0_0_0_1_1(void **state) {
    (void)state;
    const double black[64] = {0.0};
    for (int i = 0; i < SIZES; i++) {
        const dpl_signals s = signals_of(black, sizes[i]);
        assert_true(s.mean == 0.0 && s.stddev == 0.0 && s.score == 0.0 && s.non_zero == 0.0);
        assert_true(s.peak_to_average == 1.0 && s.bandwidth90 == 1.0);
    }
}

static void a_constant_ring_has_no_deviation_and_one_bin(void **state) {
    (void)state;
    double ring[64];
    for (int j = 0; j < 64; j++)
        ring[j] = 0.1; /* whose sums are rounded */
    for (int i = 0; i < SIZES; i++) {
        const dpl_signals s = signals_of(ring, sizes[i]);
        assert_true(s.mean == 0.1 && s.stddev == 0.0 && s.score == 0.1 && s.non_zero == 1.0);
        assert_true(s.peak_to_average == 1.0);
        assert_true(s.bandwidth90 == 1.0 / bins_of(sizes[i]));
    }
}

/* One sample of 1: the spectrum is flat, wherever it points. */
static void a_spike_has_a_flat_spectrum(void **state) {
    (void)state;
    const int32_t counts[] = {1, 2, 3, 7, 16, 20, 40, 64, 100};
    for (size_t i = 0; i < sizeof counts / sizeof counts[0]; i++) {
        const int32_t n = counts[i], bins = bins_of(n);
        const int32_t wanted = (9 * bins + 9) / 10; /* of 20 samples: 9 of 10 bins, a tie on paper */
        for (int32_t at = 0; at < n; at++) {
            double ring[100] = {0.0};
            ring[at] = 1.0;
            const dpl_signals s = signals_of(ring, n);
            assert_near(s.mean, 1.0 / n);
            assert_near(s.stddev, sqrt(n - 1.0) / n);
            assert_near(s.score, (1.0 + sqrt(n - 1.0)) / n);
            assert_true(s.non_zero == 1.0 / n);
            assert_near(s.peak_to_average, n);
            assert_true(s.bandwidth90 == (double)wanted / bins);
        }
    }
}

/* base + cos(2 pi k j / n) */
static dpl_signals signals_of_cosine(int32_t n, int32_t k, double base) {
    static double ring[LARGEST];
    for (int32_t j = 0; j < n; j++)
        ring[j] = base + cos(2.0 * PI * (double)(k * j % n) / n);
    return signals_of(ring, n);
}

static void a_cosine_holds_its_energy_in_its_own_bin(void **state) {
    (void)state;
    const int32_t counts[] = {3, 7, 16, 64};
    for (size_t i = 0; i < sizeof counts / sizeof counts[0]; i++)
        for (int32_t n = counts[i], k = 1; k < bins_of(n); k++) {
            const dpl_signals s = signals_of_cosine(n, k, 0.0);
            assert_true(s.bandwidth90 == (k + 1.0) / bins_of(n));
            assert_near(s.mean, 0.0);
            assert_near(s.stddev, sqrt(0.5));
        }
}

/* Bin 0 holds b^2 n^2, bin k n^2 / 4: at b = 1.5 bin 0 has exactly 90 %. */
static void a_base_of_three_halves_is_where_bin_0_takes_over_from_a_cosine(void **state) {
    (void)state;
    const int32_t counts[] = {7, 16, 64};
    for (size_t i = 0; i < sizeof counts / sizeof counts[0]; i++)
        for (int32_t n = counts[i], k = 1; k < bins_of(n); k++) {
            assert_true(signals_of_cosine(n, k, 1.499).bandwidth90 == (k + 1.0) / bins_of(n));
            assert_true(signals_of_cosine(n, k, 1.5).bandwidth90 == 1.0 / bins_of(n));
            const dpl_signals s = signals_of_cosine(n, k, 2.0);
            assert_true(s.bandwidth90 == 1.0 / bins_of(n));
            assert_near(s.score, 2.0 + sqrt(0.5));
            assert_near(s.peak_to_average, 1.5);
        }
}

/* Half the ring 1, half 0: bins 0 and 1 hold 2/3 and more than a quarter. */
static void a_two_level_square_needs_two_bins(void **state) {
    (void)state;
    const int32_t counts[] = {4, 8, 16, 64, 4096};
    for (size_t i = 0; i < sizeof counts / sizeof counts[0]; i++) {
        static double ring[LARGEST];
        const int32_t n = counts[i];
        for (int32_t j = 0; j < n; j++)
            ring[j] = j < n / 2 ? 1.0 : 0.0;
        const dpl_signals s = signals_of(ring, n);
        assert_near(s.mean, 0.5);
        assert_near(s.stddev, 0.5);
        assert_near(s.score, 1.0);
        assert_true(s.non_zero == 0.5);
        assert_near(s.peak_to_average, 2.0);
        assert_true(s.bandwidth90 == 4.0 / n);
    }
}

/* 1, 0, 1, 0: beside bin 0 all energy is in bin n/2, which is not looked at. */
static void alternating_samples_are_all_mean(void **state) {
    (void)state;
    double ring[64], signs[64];
    for (int j = 0; j < 64; j++) {
        ring[j] = j % 2 == 0 ? 1.0 : 0.0;
        signs[j] = j % 2 == 0 ? 1.0 : -1.0;
    }
    assert_true(signals_of(ring, 64).bandwidth90 == 1.0 / 32);
    assert_true(signals_of(ring, 2).bandwidth90 == 1.0);
    assert_true(signals_of(signs, 64).bandwidth90 == 1.0); /* no energy at all where it looks */
    assert_true(signals_of(signs, 64).stddev == 1.0);
}

static void samples_of_a_hundredth_count_as_zero(void **state) {
    (void)state;
    const double ring[4] = {0.01, nextafter(0.01, 1.0), -1.0, 0.0};
    assert_true(signals_of(ring, 4).non_zero == 0.25);
}

static void a_mean_of_a_thousandth_has_no_peak(void **state) {
    (void)state;
    const double dim[2] = {0.002, 0.0}, brighter[2] = {0.00201, 0.0}, negative[2] = {1.0, -2.0};
    assert_true(signals_of(dim, 2).peak_to_average == 1.0);
    assert_near(signals_of(brighter, 2).peak_to_average, 2.0);
    assert_true(signals_of(negative, 2).peak_to_average == 1.0);
}

static double random_number(uint64_t *state) {
    *state = *state * 6364136223846793005u + 1442695040888963407u;
    return (double)(*state >> 11) / 9007199254740992.0;
}

/* The definition, word for word, in long double. */
static double slow_bandwidth(const double *samples, int32_t n) {
    long double energy[64], total = 0.0L, sum = 0.0L;
    for (int32_t k = 0; k < bins_of(n); k++) {
        long double real = 0.0L, imaginary = 0.0L;
        for (int32_t j = 0; j < n; j++) {
            const long double angle = 2.0L * acosl(-1.0L) * (long double)(k * j % n) / (long double)n;
            real += (long double)samples[j] * cosl(angle);
            imaginary -= (long double)samples[j] * sinl(angle);
        }
        energy[k] = real * real + imaginary * imaginary;
        total += energy[k];
    }
    int32_t k = -1;
    while (sum < 0.9L * total)
        sum += energy[++k];
    return (k + 1.0) / bins_of(n);
}

static void bandwidth_is_that_of_the_slow_spectrum_for_every_size(void **state) {
    (void)state;
    uint64_t seed = 1;
    int distinct = 0;
    double last = -1.0;
    for (int32_t n = 1; n <= 100; n++)
        for (int round = 0; round < 4; round++) {
            double ring[100]; /* sparse to dense: few bright samples, or all of them */
            for (int32_t j = 0; j < n; j++)
                ring[j] = pow(random_number(&seed), round == 0 ? 0.5 : 4.0 * round) - (round == 3 ? 0.08 : 0);
            const double bandwidth = signals_of(ring, n).bandwidth90;
            assert_true(bandwidth == slow_bandwidth(ring, n));
            distinct += bandwidth != last;
            last = bandwidth;
        }
    assert_true(distinct > 100); /* the rings did differ */
}

static void a_ring_of_4096_is_answered(void **state) {
    (void)state;
    const dpl_signals s = signals_of_cosine(4096, 1000, 0.0);
    assert_true(s.bandwidth90 == 1001.0 / 2048);
    assert_near(s.stddev, sqrt(0.5));
}

static void scaling_a_ring_scales_what_has_a_unit_and_nothing_else(void **state) {
    (void)state;
    const double ring[7] = {1.0, 0.5, 4.0, 0.25, 2.0, 3.0, 0.125};
    const double scales[] = {0x1p600, 0x1p1021, 64.0};
    const dpl_signals one = signals_of(ring, 7);
    for (size_t i = 0; i < sizeof scales / sizeof scales[0]; i++) {
        double scaled[7];
        for (int j = 0; j < 7; j++)
            scaled[j] = ring[j] * scales[i];
        const dpl_signals s = signals_of(scaled, 7);
        assert_true(s.mean == one.mean * scales[i] && s.stddev == one.stddev * scales[i]);
        assert_true(s.peak_to_average == one.peak_to_average && s.bandwidth90 == one.bandwidth90);
    }
}

static void no_finite_ring_gives_nan(void **state) {
    (void)state;
    const double extreme[] = {DBL_MAX, -DBL_MAX, DBL_MIN, 5e-324, 0.0, 1.0};
    for (int32_t code = 0; code < 6 * 6 * 6; code++)
        for (int32_t n = 1; n <= 3; n++) {
            const double ring[3] = {extreme[code % 6], extreme[code / 6 % 6], extreme[code / 36]};
            const dpl_signals s = signals_of(ring, n);
            assert_true(isfinite(s.mean) && isfinite(s.stddev) && !isnan(s.score));
            assert_true(isfinite(s.peak_to_average) && s.non_zero >= 0.0 && s.non_zero <= 1.0);
            assert_true(s.bandwidth90 > 0.0 && s.bandwidth90 <= 1.0);
        }
}

static void a_faint_ring_keeps_its_bandwidth(void **state) {
    (void)state;
    double ring[64] = {0.0};
    ring[5] = 5e-324;
    assert_true(signals_of(ring, 64).bandwidth90 == 29.0 / 32);
}

static void bad_arguments_are_refused_and_nothing_is_written(void **state) {
    (void)state;
    const double bad[] = {(double)NAN, (double)INFINITY, -(double)INFINITY};
    dpl_signals signals, before;
    memset(&signals, 7, sizeof signals);
    memcpy(&before, &signals, sizeof before);
    double ring[3] = {1.0, 2.0, 3.0};
    assert_int_equal(dpl_signals_of_ring(NULL, 3, &signals), DPL_ERROR_ARGUMENT);
    assert_int_equal(dpl_signals_of_ring(ring, 0, &signals), DPL_ERROR_ARGUMENT);
    assert_int_equal(dpl_signals_of_ring(ring, -1, &signals), DPL_ERROR_ARGUMENT);
    assert_int_equal(dpl_signals_of_ring(ring, 3, NULL), DPL_ERROR_ARGUMENT);
    for (int i = 0; i < 9; i++) {
        double broken[3] = {1.0, 2.0, 3.0};
        broken[i / 3] = bad[i % 3];
        assert_int_equal(dpl_signals_of_ring(broken, 3, &signals), DPL_ERROR_ARGUMENT);
    }
    assert_memory_equal(&signals, &before, sizeof before);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_black_ring_gives_0_0_0_0_1_1),
        cmocka_unit_test(a_constant_ring_has_no_deviation_and_one_bin),
        cmocka_unit_test(a_spike_has_a_flat_spectrum),
        cmocka_unit_test(a_cosine_holds_its_energy_in_its_own_bin),
        cmocka_unit_test(a_base_of_three_halves_is_where_bin_0_takes_over_from_a_cosine),
        cmocka_unit_test(a_two_level_square_needs_two_bins),
        cmocka_unit_test(alternating_samples_are_all_mean),
        cmocka_unit_test(samples_of_a_hundredth_count_as_zero),
        cmocka_unit_test(a_mean_of_a_thousandth_has_no_peak),
        cmocka_unit_test(bandwidth_is_that_of_the_slow_spectrum_for_every_size),
        cmocka_unit_test(a_ring_of_4096_is_answered),
        cmocka_unit_test(scaling_a_ring_scales_what_has_a_unit_and_nothing_else),
        cmocka_unit_test(no_finite_ring_gives_nan),
        cmocka_unit_test(a_faint_ring_keeps_its_bandwidth),
        cmocka_unit_test(bad_arguments_are_refused_and_nothing_is_written),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
