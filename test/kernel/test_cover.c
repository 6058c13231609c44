/* The kernels that say what runs of opaque pixels cover of a disc: every instruction set equals the scalar
 * reference bit for bit, and that one says what geometry says. */
#include "testing.h"

#include "kernel/kernel.h"

#include <math.h>
#include <string.h>

enum { MOST = 9, CHAINS = 12, WORLDS = 400 };

static const dpl_isa isas[] = {DPL_ISA_SSE2, DPL_ISA_AVX2, DPL_ISA_AVX512};

static uint32_t seed;

static float random_between(double low, double high) {
    seed = seed * 1664525u + 1013904223u;
    return (float)(low + (high - low) * (seed >> 8) / 16777216.0);
}

static dpl_receivers receivers_of(double along, double radius, double light) {
    dpl_receivers r;
    memset(&r, 0, sizeof r);
    r.along = (float)along;
    r.radius = (float)radius;
    for (int i = 0; i < DPL_RECEIVERS; i++) {
        r.across[i] = (float)i + 0.5f;
        r.toward[i] = (float)(light - i - 0.5);
    }
    return r;
}

/* A disc and chains of runs at random: some too wide, some careful, some of many spans. */
static void run_world(const dpl_kernels *kernels, uint32_t number, dpl_receivers *r, float *visible,
                      bool done[CHAINS]) {
    seed = number * 7919u + 1u;
    double along = (double)random_between(3, 90), light = (double)random_between(-40, 70);
    *r = receivers_of(along, (double)random_between(0.3, 0.6 * along), light);
    kernels->face_disc(r);
    for (int c = 0; c < CHAINS; c++) {
        float first[MOST], end[MOST], near[MOST], far[MOST];
        dpl_runs runs = {(int32_t)(number + (uint32_t)c) % MOST, first, end, near, far};
        float v = random_between(-60, 90);
        for (int32_t i = 0; i < runs.count; i++) {
            float k = floorf(random_between(0, along));
            first[i] = floorf(v);
            end[i] = first[i] + 1.0f + floorf(random_between(0, 2));
            near[i] = k < 1.0f ? 1e6f : 1.0f / (k - 0.5f);
            far[i] = 1.0f / (k + 0.5f);
        }
        done[c] = kernels->cover_runs(r, &runs, number % 5 == 0 && c == 3);
    }
    kernels->share_seen(r, visible);
}

static void covers_equal_the_reference(void **state) {
    (void)state;
    int found[4] = {0}; /* lost, dark, between, lit */
    for (uint32_t number = 0; number < WORLDS; number++) {
        dpl_receivers expected, r;
        float visible[2][DPL_RECEIVERS];
        bool done[2][CHAINS];
        run_world(&dpl_kernels_ref, number, &expected, visible[0], done[0]);
        for (size_t k = 0; k < sizeof isas / sizeof isas[0]; k++) {
            const dpl_kernels *kernels = dpl_kernels_select((uint32_t)isas[k]);
            if (!kernels)
                continue;
            run_world(kernels, number, &r, visible[1], done[1]);
            assert_memory_equal(visible[0], visible[1], sizeof visible[0]);
            assert_memory_equal(done[0], done[1], sizeof done[0]);
            for (int i = 0; i < DPL_RECEIVERS; i++)
                assert_true(expected.lost[i] == r.lost[i]);
        }
        for (int i = 0; i < DPL_RECEIVERS; i++)
            found[visible[0][i] < 0.0f ? 0 : visible[0][i] < 1e-6f ? 1 : visible[0][i] < 1.0f ? 2 : 3]++;
    }
    for (int i = 0; i < 4; i++)
        assert_true(found[i] > WORLDS / 2);
}

static double clamp(double v, double limit) {
    return v > limit ? limit : v < -limit ? -limit : v;
}

/* A square half way, against the angles of its corners. */
static void a_square_covers_the_angle_of_its_corners(void **state) {
    (void)state;
    float first = 15, end = 17, near = 1.0f / 40.0f, far = 1.0f / 42.0f, visible[DPL_RECEIVERS];
    dpl_receivers r = receivers_of(100, 9, 20);
    dpl_runs runs = {1, &first, &end, &near, &far};
    dpl_kernels_ref.face_disc(&r);
    assert_false(dpl_kernels_ref.cover_runs(&r, &runs, false));
    dpl_kernels_ref.share_seen(&r, visible);
    int partly = 0;
    for (int i = 0; i < DPL_RECEIVERS; i++) {
        double t = 20 - i - 0.5, middle = atan2(t, 100), half = asin(9 / hypot(100, t)), low = 9, high = -9;
        for (int k = 0; k < 4; k++) {
            double angle = atan2((k & 1 ? 17 : 15) - i - 0.5, k & 2 ? 40 : 42) - middle;
            low = fmin(low, angle);
            high = fmax(high, angle);
        }
        double wanted = 1.0 - (clamp(high, half) - clamp(low, half)) / (2.0 * half);
        assert_true(fabs((double)visible[i] - wanted) < 2e-5);
        partly += wanted > 0.01 && wanted < 0.99;
    }
    assert_true(partly > 10);
}

static void spans_that_touch_are_one_and_too_many_are_lost(void **state) {
    (void)state;
    float near = 1.0f / 50.0f, far = 1.0f / 51.0f, visible[DPL_RECEIVERS];
    dpl_receivers r = receivers_of(100, 30, 16);
    dpl_kernels_ref.face_disc(&r);
    for (int k = 0; k < 5; k++) { /* slits between 5 bars */
        float first = (float)(8 + 4 * k), end = first + 2.0f;
        dpl_runs runs = {1, &first, &end, &near, &far};
        dpl_kernels_ref.share_seen(&r, visible);
        assert_true(visible[16] > 0.0f);
        (void)dpl_kernels_ref.cover_runs(&r, &runs, false);
    }
    dpl_kernels_ref.share_seen(&r, visible);
    assert_true(visible[16] == -1.0f);
    r = receivers_of(100, 30, 16);
    dpl_kernels_ref.face_disc(&r);
    for (int k = 0; k < 9; k++) { /* the same and what is between them: first bars, then the gaps */
        float first = (float)(8 + (k < 4 ? 4 * k : 4 * (k - 4) - 2)), end = first + 2.0f;
        dpl_runs runs = {1, &first, &end, &near, &far};
        (void)dpl_kernels_ref.cover_runs(&r, &runs, false);
    }
    dpl_kernels_ref.share_seen(&r, visible);
    assert_true(visible[16] > 0.0f && visible[16] < 1.0f);
    float first = -200, end = 200;
    dpl_runs wall = {1, &first, &end, &near, &far};
    assert_true(dpl_kernels_ref.cover_runs(&r, &wall, false));
    dpl_kernels_ref.share_seen(&r, visible);
    for (int i = 0; i < DPL_RECEIVERS; i++)
        assert_true(visible[i] == 0.0f);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(covers_equal_the_reference),
        cmocka_unit_test(a_square_covers_the_angle_of_its_corners),
        cmocka_unit_test(spans_that_touch_are_one_and_too_many_are_lost),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
