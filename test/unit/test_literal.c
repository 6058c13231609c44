/* What the M.R.M.A. paper's equations evaluate to as printed, pinned, beside the forms that work. */
#include "testing.h"

#include "shadow/literal.h"
#include "shadow/moments.h"

#include <math.h>

static double random_unit(uint32_t *seed) {
    *seed = *seed * 1664525u + 1013904223u;
    return (*seed >> 8) / 16777216.0;
}

/* Moments of a few depths within 0 .. 1. */
static void random_moments(uint32_t *seed, double *mu1, double *mu2) {
    int count = 2 + (int)(random_unit(seed) * 6);
    *mu1 = *mu2 = 0.0;
    for (int i = 0; i < count; i++) {
        double z = random_unit(seed);
        *mu1 += z / count;
        *mu2 += z * z / count;
    }
}

static void its_probability_is_never_below_one_and_its_shadow_always_zero(void **state) {
    (void)state;
    uint32_t seed = 1;
    for (int i = 0; i < 100000; i++) {
        double mu1, mu2, d = random_unit(&seed);
        random_moments(&seed, &mu1, &mu2);
        if (mu2 - mu1 * mu1 < 1e-9)
            continue;
        double p = dpl_literal_p_occlusion(mu1, mu2, d);
        assert_true(p >= 1.0 - 1e-6);                        /* E1 */
        assert_true(dpl_literal_s_msm(mu1, mu2, d) <= 1e-6); /* E2 */
        if (d > mu1)                                         /* it is the reciprocal of Cantelli's bound */
            assert_true(fabs(1.0 / p - dpl_moments_cantelli(mu1, mu2, d, 0.0)) < 1e-9);
    }
}

static void two_moments_bleed_where_four_do_not(void **state) {
    (void)state;
    assert_true(fabs(dpl_moments_cantelli(0.6, 0.45, 1.0, 0.0) - 0.36) < 1e-12); /* E3: {.3, .9} before 1 */
    double b[4] = {0};
    for (int i = 0; i < 2; i++) {
        double one[4];
        dpl_moments_of(i ? 0.8 : -0.4, one); /* the same depths within -1 .. 1 */
        for (int k = 0; k < 4; k++)
            b[k] += 0.5 * one[k];
    }
    dpl_moments_add_bias(b, DPL_MOMENTS_BIAS_FLOAT, DPL_MOMENTS_TARGET_FLOAT);
    assert_true(dpl_moments_visibility(b, 1.0) < 0.01);
}

static void without_the_square_the_shadow_is_at_least_one_and_knows_its_unit(void **state) {
    (void)state;
    uint32_t seed = 2;
    for (int i = 0; i < 100000; i++) {
        double mu1, mu2, d = random_unit(&seed);
        random_moments(&seed, &mu1, &mu2);
        if (mu1 - mu2 < 1e-9)
            continue;
        assert_true(dpl_literal_s_msm_final(mu1, mu2, d) >= 1.0 - 1e-9); /* E4 */
    }
    double metres = dpl_literal_s_msm_final(0.5, 0.3, 0.5),
           centimetres = dpl_literal_s_msm_final(50, 3000, 50);
    assert_true(fabs(metres - 1.25) < 1e-9 && centimetres < 0.9);
}

static void its_test_has_two_tails_and_no_floor(void **state) {
    (void)state;
    double before = 1.0 / dpl_literal_p_occlusion(0.5, 0.26, 0.3),
           behind = 1.0 / dpl_literal_p_occlusion(0.5, 0.26, 0.7);
    assert_true(fabs(before - behind) < 1e-9 && before < 0.5); /* E5: darkens what stands before the mean */
    assert_true(dpl_moments_cantelli(0.5, 0.26, 0.3, 0.0) == 1.0);
    assert_true(isnan(dpl_literal_p_occlusion(0.5, 0.25, 0.5)));
    assert_true(isinf(dpl_literal_p_occlusion(0.5, 0.25, 0.7)));
}

static void its_weight_is_above_one(void **state) {
    (void)state;
    for (int i = 1; i < 100; i++) {
        double d = i / 10.0;
        assert_true(dpl_literal_alpha(d, 0.2) > 1.0); /* E6 */
    }
    assert_true(fabs(dpl_literal_alpha(0.1, 0.2) - 3.0) < 1e-12 && 1.0 - dpl_literal_alpha(0.1, 0.2) < -1.9);
}

static void its_sum_has_equal_summands_of_at_least_one(void **state) {
    (void)state;
    uint32_t seed = 3;
    for (int i = 0; i < 100000; i++) {
        double mu1, mu2, d = 0.05 + 0.95 * random_unit(&seed), k = random_unit(&seed);
        random_moments(&seed, &mu1, &mu2);
        if (mu1 - mu2 < 1e-9)
            continue;
        double occlusion = 3.0 * random_unit(&seed), cosine = 2.0 * random_unit(&seed) - 1.0;
        assert_true(dpl_literal_summand(mu1, mu2, d, k, 1.0, occlusion, cosine) >= 1.0 - 1e-9); /* E7 */
    }
}

static void its_exponent_lights_what_faces_away_and_darkens_open_rays(void **state) {
    (void)state;
    assert_true(dpl_literal_s_sdf_final(1.0, 5.0, -0.5) == 1.0); /* E8: facing away is fully lit */
    assert_true(dpl_literal_s_sdf_final(1.0, 0.0, 0.2) == 1.0);
    assert_true(dpl_literal_s_sdf(1.0, 5.0, -0.5) == 0.0); /* E9: the other printed form is irradiance */
    double open_ray = dpl_literal_s_sdf(0.5, 12.0, 1.0), hit_ray = dpl_literal_s_sdf(0.5, 4.5, 1.0);
    assert_true(open_ray < 0.003 && hit_ray > 0.1);       /* E11: a longer free path is darker */
    assert_true(dpl_literal_s_sdf(0.5, 0.0, 1.0) == 1.0); /* E10, E12: a march that starts on the surface */
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(its_probability_is_never_below_one_and_its_shadow_always_zero),
        cmocka_unit_test(two_moments_bleed_where_four_do_not),
        cmocka_unit_test(without_the_square_the_shadow_is_at_least_one_and_knows_its_unit),
        cmocka_unit_test(its_test_has_two_tails_and_no_floor),
        cmocka_unit_test(its_weight_is_above_one),
        cmocka_unit_test(its_sum_has_equal_summands_of_at_least_one),
        cmocka_unit_test(its_exponent_lights_what_faces_away_and_darkens_open_rays),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
