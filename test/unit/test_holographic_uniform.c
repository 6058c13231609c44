/* Where light is the same everywhere, the holographic solver says so at every pixel, whatever the size: the
 * weights of its cones sum up, nothing is lost at edges and between levels, and no darkness leaks in. */
#include "holographic.h"

/* Rounding of floats, and of a half that holds the light. */
static const double tolerances[] = {4e-7, 5e-4};

static void assert_sky_alone(dpl_solver *solver, int32_t width, int32_t height, double tolerance) {
    dpl_field *field = truth_field(width, height, 0);
    hrc_set_sky(field, 0.7);
    float *rgb = hrc_solve_with(solver, field);
    hrc_assert_uniform(field, rgb, 0.7, tolerance);
    free(rgb);
    dpl_field_destroy(field);
}

static void an_empty_world_of_any_size_is_its_sky(void **state) {
    (void)state;
    static const int32_t odd[][2] = {{64, 64}, {65, 63}, {127, 129}, {97, 200}, {257, 31}, {31, 513}};
    for (int storage = 0; storage < 2; storage++) {
        dpl_solver *solver = hrc_solver_in(context, (dpl_storage)storage);
        for (int32_t width = 1; width <= 40; width++)
            for (int32_t height = 1; height <= 40; height++)
                assert_sky_alone(solver, width, height, tolerances[storage]);
        for (size_t i = 0; i < sizeof odd / sizeof odd[0]; i++)
            assert_sky_alone(solver, odd[i][0], odd[i][1], tolerances[storage]);
        dpl_solver_destroy(solver);
    }
}

static void strips_as_long_as_they_may_be_are_their_sky(void **state) {
    (void)state;
    dpl_solver *solver = hrc_solver_in(context, DPL_STORAGE_FLOAT);
    assert_sky_alone(solver, 1, DPL_MAX_SIZE, tolerances[0]);
    assert_sky_alone(solver, DPL_MAX_SIZE, 1, tolerances[0]);
    /* They have more levels than statistics have places. */
    dpl_solver_stats stats;
    int64_t full = 0;
    dpl_solver_read_stats(solver, &stats);
    assert_int_equal(stats.level_count, DPL_MAX_LEVELS);
    for (int32_t n = 0; n < stats.level_count; n++)
        full += stats.levels[n].full;
    assert_true(full > 0 && full == stats.rays_full);
    assert_int_equal(stats.skip.signal_rays, 0);
    assert_sky_alone(solver, 3, 2000, tolerances[0]);
    dpl_solver_destroy(solver);
}

/* A room with walls of one pixel: of levels 1, of one strip, of several. */
static void inside_a_glowing_room_there_is_its_glow(void **state) {
    (void)state;
    static const int32_t sizes[][2] = {{3, 3}, {4, 9}, {16, 17}, {33, 20}, {34, 20}, {64, 64}, {127, 131}};
    for (int storage = 0; storage < 2; storage++)
        for (size_t i = 0; i < sizeof sizes / sizeof sizes[0]; i++) {
            dpl_field *field = truth_field(sizes[i][0], sizes[i][1], 0);
            truth_box(field, 0, 0, sizes[i][0], sizes[i][1], truth_wall(0.7, 0.0));
            truth_box(field, 1, 1, sizes[i][0] - 1, sizes[i][1] - 1, truth_air());
            float *rgb = hrc_solve(field, (dpl_storage)storage);
            hrc_assert_uniform(field, rgb, 0.7, tolerances[storage]);
            free(rgb);
            dpl_field_destroy(field);
        }
}

/* Fog, coloured fog in one half, and a wall, all as bright as the sky. */
static void what_glows_like_the_sky_cannot_be_told_from_it(void **state) {
    (void)state;
    static const int32_t sizes[][2] = {{1, 1}, {2, 7}, {16, 17}, {33, 40}, {65, 64}, {127, 131}};
    for (size_t i = 0; i < sizeof sizes / sizeof sizes[0]; i++) {
        int32_t w = sizes[i][0], h = sizes[i][1];
        dpl_field *field = truth_field(w, h, 0);
        hrc_set_sky(field, 0.7);
        const dpl_material fogs[] = {hrc_fog(0.7, 0.03, 0.03, 0.03), hrc_fog(0.7, 0.01, 0.3, 2.0)};
        for (int step = 0; step < 3; step++) {
            if (step < 2)
                truth_box(field, 0, 0, step ? 0.5 * w : w, h, fogs[step]);
            else
                truth_box(field, w / 2, h / 3, w / 2 + 1, h, truth_wall(0.7, 0.0));
            float *rgb = hrc_solve(field, DPL_STORAGE_FLOAT);
            hrc_assert_uniform(field, rgb, 0.7, tolerances[0]);
            free(rgb);
        }
        dpl_field_destroy(field);
    }
}

static void a_world_of_walls_is_their_emission(void **state) {
    (void)state;
    for (int storage = 0; storage < 2; storage++) {
        dpl_field *field = truth_field(37, 70, 0);
        hrc_set_sky(field, 3.0);
        truth_box(field, 0, 0, 37, 70, truth_wall(0.7, 0.0));
        float *rgb = hrc_solve(field, (dpl_storage)storage);
        hrc_assert_uniform(field, rgb, (double)0.7f, 0.0);
        free(rgb);
        dpl_field_destroy(field);
    }
}

static void without_light_all_is_exactly_dark(void **state) {
    (void)state;
    for (int storage = 0; storage < 2; storage++)
        for (int scene = 0; scene < 3; scene++) {
            dpl_field *field = truth_field(67, 40, 0);
            if (scene > 0)
                truth_box(field, 10, 5, 30, 30, truth_wall(0.0, 0.0));
            if (scene > 1)
                truth_box(field, 20, 10, 60, 38, hrc_fog(0.0, 0.01, 0.5, 4.0));
            float *rgb = hrc_solve(field, (dpl_storage)storage);
            for (size_t i = 0; i < hrc_values(field); i++)
                assert_true(rgb[i] == 0.0f);
            free(rgb);
            dpl_field_destroy(field);
        }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(an_empty_world_of_any_size_is_its_sky),
        cmocka_unit_test(strips_as_long_as_they_may_be_are_their_sky),
        cmocka_unit_test(inside_a_glowing_room_there_is_its_glow),
        cmocka_unit_test(what_glows_like_the_sky_cannot_be_told_from_it),
        cmocka_unit_test(a_world_of_walls_is_their_emission),
        cmocka_unit_test(without_light_all_is_exactly_dark),
    };
    return cmocka_run_group_tests(tests, open_context, close_context);
}
