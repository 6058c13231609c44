/* The holographic solver with half storage: what it costs in accuracy, what it saves in memory, and that
 * light which no half can hold does no harm. */
#include "holographic.h"
#include "world.h"

/* Measured: 0.0002 without media, 0.0008 with. */
static void halves_are_as_good_as_floats(void **state) {
    (void)state;
    for (uint32_t seed = 1; seed <= 6; seed++) {
        dpl_field *field = dpl_test_world(context, 120, 90, seed, seed % 2);
        float *floats = hrc_solve(field, DPL_STORAGE_FLOAT), *halves = hrc_solve(field, DPL_STORAGE_HALF);
        double error = hrc_error(field, halves, floats);
        assert_true(error > 0.0 && error < (seed % 2 ? 1e-3 : 3e-4));
        free(floats);
        free(halves);
        dpl_field_destroy(field);
    }
}

/* A limit of half storage: near 1 a half has steps of 2^-11, so what a thin fog takes on half a pixel is
 * rounded, while what it gives is not. Under a sky as bright as the fog all should be the same; measured it
 * is wrong by up to 2.1 % of the sky at this size, and more the larger the world. */
static void thin_fog_is_off_by_a_few_per_cent(void **state) {
    (void)state;
    static const double extinctions[] = {0.0002, 0.0005, 0.001, 0.005, 0.01, 0.03, 0.1, 1.0};
    double worst = 0.0;
    for (size_t i = 0; i < sizeof extinctions / sizeof extinctions[0]; i++) {
        dpl_field *field = truth_field(100, 100, 0);
        hrc_set_sky(field, 0.7);
        truth_box(field, 0, 0, 100, 100, hrc_fog(0.7, extinctions[i], extinctions[i], extinctions[i]));
        float *rgb = hrc_solve(field, DPL_STORAGE_HALF);
        for (size_t k = 0; k < hrc_values(field); k++)
            worst = fmax(worst, fabs((double)rgb[k] / 0.7 - 1.0));
        free(rgb);
        dpl_field_destroy(field);
    }
    assert_true(worst < 0.025);
}

/* The same limit in numbers: halves see a medium's extinction with an error of up to 0.0005 per pixel, so
 * that fog thinner than that may not be there at all. Along a fog before a lit wall. */
static void extinction_is_off_by_a_two_thousandth_at_most(void **state) {
    (void)state;
    enum { WIDTH = 120, HEIGHT = 120 };
    static const double extinctions[] = {0.0002, 0.0004, 0.001, 0.004, 0.01, 0.05};
    for (size_t i = 0; i < sizeof extinctions / sizeof extinctions[0]; i++) {
        dpl_field *field = truth_field(WIDTH, HEIGHT, 0);
        truth_box(field, 0, 0, WIDTH, HEIGHT, hrc_fog(0.0, extinctions[i], extinctions[i], extinctions[i]));
        truth_box(field, 0, 0, 2, HEIGHT, truth_wall(1.0, 0.0));
        float *halves = hrc_solve(field, DPL_STORAGE_HALF), *floats = hrc_solve(field, DPL_STORAGE_FLOAT);
        for (int32_t x = 3; x < WIDTH; x++) {
            size_t at = 3 * ((size_t)(HEIGHT / 2) * WIDTH + (size_t)x);
            /* seen at angles of up to 45 degrees */
            truth_assert_near(log((double)halves[at] / (double)floats[at]), 0.0, 0.002 + 0.0005 * 1.2 * x);
        }
        free(halves);
        free(floats);
        dpl_field_destroy(field);
    }
}

/* A lamp and a wall in its light; the picture, and the free pixels' error against floats. */
static float *lit_by(double emission, dpl_storage storage, double *error) {
    dpl_field *field = truth_field(50, 50, 0);
    truth_box(field, 20, 20, 30, 26, truth_wall(emission, 0.0));
    truth_box(field, 5, 30, 45, 31, truth_wall(0.0, 0.0));
    float *rgb = hrc_solve(field, storage), *floats = hrc_solve(field, DPL_STORAGE_FLOAT);
    for (size_t i = 0; i < hrc_values(field); i++)
        assert_true(isfinite(rgb[i]) && rgb[i] >= 0.0f);
    *error = hrc_error(field, rgb, floats);
    free(floats);
    dpl_field_destroy(field);
    return rgb;
}

/* Beyond the range of halves a lamp lights as the brightest that they hold; it shows as what it is. */
static void lamps_too_bright_for_a_half_light_as_the_brightest(void **state) {
    (void)state;
    static const double emissions[] = {1e9, 1e30, 3e38};
    double error;
    float *brightest = lit_by(65504.0, DPL_STORAGE_HALF, &error);
    assert_true(error < 5e-4);
    for (size_t k = 0; k < 3; k++) {
        float *rgb = lit_by(emissions[k], DPL_STORAGE_HALF, &error);
        for (size_t i = 0; i < 7500; i++)
            assert_true(rgb[i] == (brightest[i] == 65504.0f ? (float)emissions[k] : brightest[i]));
        free(rgb);
    }
    free(brightest);
}

/* Floats that are near their own end are handled alike: no infinity is made, and so no not-a-number. */
static void the_brightest_lamps_and_skies_keep_floats_finite(void **state) {
    (void)state;
    double error;
    free(lit_by(3e38, DPL_STORAGE_FLOAT, &error));
    dpl_field *field = truth_field(40, 33, 0);
    hrc_set_sky(field, 3e38);
    truth_box(field, 10, 10, 30, 20, truth_wall(3e38, 0.0));
    truth_box(field, 20, 15, 40, 30, hrc_fog(3e38, 0.1, 0.2, 0.3));
    float *rgb = hrc_solve(field, DPL_STORAGE_FLOAT);
    for (size_t i = 0; i < hrc_values(field); i++)
        assert_true(isfinite(rgb[i]) && rgb[i] > 1e36f);
    free(rgb);
    dpl_field_destroy(field);
}

/* The smallest half is 6e-8: what is dimmer than 1e-4 loses precision, and at 1e-7 not much is left of it. */
static void dim_lamps_lose_precision_but_nothing_else(void **state) {
    (void)state;
    static const double emissions[][2] = {{1e-4, 7e-4}, {1e-5, 6e-3}, {1e-6, 0.06}, {1e-7, 1.0}, {1e-8, 1.6}};
    for (size_t i = 0; i < sizeof emissions / sizeof emissions[0]; i++) {
        double error;
        free(lit_by(emissions[i][0], DPL_STORAGE_HALF, &error));
        assert_true(error < emissions[i][1]);
    }
}

/* What is left in floats are the sums of quadrants and a band of rows: 0.59 of the memory, 0.54 with media.
 */
static void halves_take_little_more_than_half_the_memory(void **state) {
    (void)state;
    for (int media = 0; media < 2; media++) {
        dpl_solver_stats stats[2];
        for (int storage = 0; storage < 2; storage++) {
            dpl_field *field = dpl_test_world(context, 256, 200, 3, media);
            dpl_solver *solver = hrc_solver_in(context, (dpl_storage)storage);
            free(hrc_solve_with(solver, field));
            dpl_solver_read_stats(solver, &stats[storage]);
            dpl_solver_destroy(solver);
            dpl_field_destroy(field);
        }
        assert_true(stats[1].memory_bytes > 0);
        assert_true((double)stats[1].memory_bytes < 0.6 * (double)stats[0].memory_bytes);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(halves_are_as_good_as_floats),
        cmocka_unit_test(thin_fog_is_off_by_a_few_per_cent),
        cmocka_unit_test(extinction_is_off_by_a_two_thousandth_at_most),
        cmocka_unit_test(lamps_too_bright_for_a_half_light_as_the_brightest),
        cmocka_unit_test(the_brightest_lamps_and_skies_keep_floats_finite),
        cmocka_unit_test(dim_lamps_lose_precision_but_nothing_else),
        cmocka_unit_test(halves_take_little_more_than_half_the_memory),
    };
    return cmocka_run_group_tests(tests, open_context, close_context);
}
