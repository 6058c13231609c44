/* A sky per direction: means over angles, what solvers make of it, and what is refused. */
#include "truth.h"

#include "field/field.h"

enum { WIDTH = 33, HEIGHT = 21 };

/* ---- means ---------------------------------------------------------------------------------------- */

/* Seven sectors that all differ. */
static dpl_field *open_ring(float ring[7][3]) {
    dpl_field *field = truth_field(WIDTH, HEIGHT, 0);
    for (int k = 0; k < 7; k++)
        for (int c = 0; c < 3; c++)
            ring[k][c] = (float)((k * 5 + c * 3) % 11);
    assert_ok(dpl_field_set_sky_ring(field, (const float(*)[3])ring, 7));
    return field;
}

static void a_mean_is_the_integral_over_its_angles(void **state) {
    (void)state;
    static const double ends[][2] = {
        {0.1, 0.2},     {0.0, 2.0 * TRUTH_PI}, {0.5, 4.0},  {-3.0, 1.0}, {6.0, 7.0},
        {-20.0, -19.0}, {100.0, 101},          {1.0, 17.3}, {-9, 40},    {3.0, 3.0},
    };
    float ring[7][3];
    dpl_field *field = open_ring(ring);
    for (size_t i = 0; i < sizeof ends / sizeof ends[0]; i++) {
        const int steps = 100000;
        double sum[3] = {0.0, 0.0, 0.0};
        float mean[3];
        for (int s = 0; s < steps; s++) {
            double angle = ends[i][0] + (ends[i][1] - ends[i][0]) * (s + 0.5) / steps;
            double turns = angle / (2.0 * TRUTH_PI);
            int k = (int)((turns - floor(turns)) * 7.0);
            for (int c = 0; c < 3; c++)
                sum[c] += (double)ring[k][c] / steps;
        }
        dpl_field_sky_mean(field, ends[i][0], ends[i][1], mean);
        for (int c = 0; c < 3; c++)
            truth_assert_near((double)mean[c], sum[c], 2e-4);
    }
    dpl_field_destroy(field);
}

static void sectors_begin_at_plus_x_and_go_towards_plus_y(void **state) {
    (void)state;
    float ring[7][3];
    dpl_field *field = open_ring(ring);
    for (int k = -14; k < 14; k++) {
        const float *own = ring[(k + 14) % 7];
        double sector = 2.0 * TRUTH_PI / 7.0;
        float mean[3];
        assert_memory_equal(dpl_field_sky_at(field, (k + 0.5) * sector), own, sizeof mean);
        dpl_field_sky_mean(field, (k + 0.001) * sector, (k + 0.999) * sector, mean);
        assert_memory_equal(mean, own, sizeof mean);
        dpl_field_sky_mean(field, (k + 0.25) * sector, (k + 1.25) * sector, mean);
        for (int c = 0; c < 3; c++) {
            double next = (double)ring[(k + 15) % 7][c];
            truth_assert_near((double)mean[c], 0.75 * (double)own[c] + 0.25 * next, 1e-5);
        }
    }
    dpl_field_destroy(field);
}

/* ---- solvers -------------------------------------------------------------------------------------- */

static void draw_obstacles(dpl_field *field) {
    truth_box(field, 5, 5, 9, 16, truth_wall(0.0, 0.0));
    truth_box(field, 20, 3, 24, 6, truth_wall(1.0, 0.0));
}

static void solve_with(const dpl_solver_desc *desc, dpl_field *field, float *rgb) {
    dpl_solver *solver;
    dpl_output output = {.data = rgb, .width = WIDTH, .height = HEIGHT, .channels = 3};
    assert_ok(dpl_solver_create(context, desc, &solver));
    assert_ok(dpl_solver_solve(solver, field, &output));
    dpl_solver_destroy(solver);
}

static void equal_sectors_are_a_constant_sky(void **state) {
    (void)state;
    static const float sky[3] = {0.3f, 0.7f, 1.9f};
    static float ring[4096][3], constant[WIDTH * HEIGHT * 3], found[WIDTH * HEIGHT * 3];
    for (int k = 0; k < 4096; k++)
        memcpy(ring[k], sky, sizeof sky);
    for (int kind = 0; kind < 5; kind++) {
        dpl_solver_desc desc = dpl_solver_desc_default();
        desc.kind = kind == 4 ? DPL_SOLVER_REFERENCE : DPL_SOLVER_CASCADES;
        desc.reference.directions = 100;
        desc.cascades.merge = kind < 3 ? (dpl_merge)kind : DPL_MERGE_BILINEAR;
        desc.cascades.profile = kind == 3 ? DPL_PROFILE_PAPER : DPL_PROFILE_DEFAULT;
        desc.cascades.skip.mode = kind == 0 ? DPL_SKIP_AUTO : DPL_SKIP_OFF;
        dpl_field_desc field_desc = dpl_field_desc_default();
        field_desc.width = WIDTH;
        field_desc.height = HEIGHT;
        field_desc.keep_shape_distance = kind == 3;
        dpl_field *field;
        assert_ok(dpl_field_create(context, &field_desc, &field));
        draw_obstacles(field);
        assert_ok(dpl_field_set_sky(field, sky));
        solve_with(&desc, field, constant);
        for (int32_t count = 1; count <= 4096; count = 3 * count + 1) {
            assert_ok(dpl_field_set_sky_ring(field, (const float(*)[3])ring, count));
            solve_with(&desc, field, found);
            assert_memory_equal(constant, found, sizeof found);
        }
        dpl_field_destroy(field);
    }
}

static void under_an_open_ring_everything_sees_its_mean(void **state) {
    (void)state;
    static float rgb[WIDTH * HEIGHT * 3];
    float ring[7][3];
    dpl_field *field = open_ring(ring);
    for (int kind = DPL_SOLVER_CASCADES; kind <= DPL_SOLVER_REFERENCE; kind++) {
        dpl_solver_desc desc = dpl_solver_desc_default();
        desc.kind = (dpl_solver_kind)kind;
        solve_with(&desc, field, rgb);
        double mean[3] = {0.0, 0.0, 0.0};
        for (int k = 0; k < 7; k++)
            for (int c = 0; c < 3; c++)
                mean[c] += (double)ring[k][c] / 7.0;
        for (int i = 0; i < WIDTH * HEIGHT * 3; i++)
            truth_assert_close((double)rgb[i], mean[i % 3], kind == DPL_SOLVER_REFERENCE ? 7.0 / 4096 : 1e-5);
    }
    dpl_field_destroy(field);
}

static void a_wall_hides_the_half_of_the_sky_behind_it(void **state) {
    (void)state;
    /* Light from the right alone, and a wall over the whole height with the picture's right edge far away:
     * left of it, what comes over its two ends; right of it, one half. */
    static float rgb[2][WIDTH * HEIGHT * 3];
    dpl_field *field = truth_field(WIDTH, HEIGHT, 0);
    float right[4][3] = {{1, 1, 1}, {0, 0, 0}, {0, 0, 0}, {1, 1, 1}};
    assert_ok(dpl_field_set_sky_ring(field, (const float(*)[3])right, 4));
    truth_box(field, 16, 0, 17, HEIGHT, truth_wall(0.0, 0.0));
    dpl_solver_desc desc = dpl_solver_desc_default();
    desc.kind = DPL_SOLVER_CASCADES;
    solve_with(&desc, field, rgb[0]);
    desc.kind = DPL_SOLVER_REFERENCE;
    solve_with(&desc, field, rgb[1]);
    for (int32_t x = 0; x < WIDTH; x++) {
        double hidden = x < 16 ? 2.0 * atan2(10.5, 16.0 - (x + 0.5)) / (2.0 * TRUTH_PI) : 0.0;
        size_t at = ((size_t)10 * WIDTH + (size_t)x) * 3;
        if (x == 16)
            continue;
        truth_assert_near((double)rgb[1][at], 0.5 - hidden, 2.0 / 4096);
        truth_assert_near((double)rgb[0][at], 0.5 - hidden, 0.03); /* cascades blur at borders and walls */
    }
    dpl_field_destroy(field);
}

/* ---- what is refused ------------------------------------------------------------------------------ */

static void a_refused_ring_changes_nothing(void **state) {
    (void)state;
    float ring[7][3], bad[2][3] = {{1, 1, 1}, {1, -1, 1}};
    dpl_field *field = open_ring(ring);
    assert_int_equal(dpl_field_set_sky_ring(field, NULL, 2), DPL_ERROR_ARGUMENT);
    assert_int_equal(dpl_field_set_sky_ring(NULL, (const float(*)[3])bad, 2), DPL_ERROR_ARGUMENT);
    assert_int_equal(dpl_field_set_sky_ring(field, (const float(*)[3])bad, 0), DPL_ERROR_ARGUMENT);
    assert_string_equal(dpl_context_message(context), "a sky has 1 .. 4096 sectors, not 0");
    assert_int_equal(dpl_field_set_sky_ring(field, (const float(*)[3])bad, 4097), DPL_ERROR_ARGUMENT);
    assert_int_equal(dpl_field_set_sky_ring(field, (const float(*)[3])bad, 2), DPL_ERROR_ARGUMENT);
    assert_string_equal(dpl_context_message(context), "sector 1 of the sky must be finite and not negative");
    bad[1][1] = INFINITY;
    assert_int_equal(dpl_field_set_sky_ring(field, (const float(*)[3])bad, 2), DPL_ERROR_ARGUMENT);
    for (int k = 0; k < 7; k++)
        assert_memory_equal(dpl_field_sky_at(field, (k + 0.5) * 2.0 * TRUTH_PI / 7.0), ring[k],
                            sizeof ring[k]);
    dpl_field_destroy(field);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_mean_is_the_integral_over_its_angles),
        cmocka_unit_test(sectors_begin_at_plus_x_and_go_towards_plus_y),
        cmocka_unit_test(equal_sectors_are_a_constant_sky),
        cmocka_unit_test(under_an_open_ring_everything_sees_its_mean),
        cmocka_unit_test(a_wall_hides_the_half_of_the_sky_behind_it),
        cmocka_unit_test(a_refused_ring_changes_nothing),
    };
    return cmocka_run_group_tests(tests, open_context, close_context);
}
