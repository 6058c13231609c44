/* Where the light comes from: first-order coefficients against closed forms. */
#include "truth.h"

enum { WIDTH = 31, HEIGHT = 19, PIXELS = WIDTH * HEIGHT };

typedef struct answer {
    float mean[PIXELS][3];
    float cosine[PIXELS][4];
    float sine[PIXELS][3];
} answer;

static answer found;

static void solve(dpl_field *field, int32_t directions, int32_t bounces) {
    dpl_solver *solver = truth_solver(directions, bounces);
    dpl_output mean = {.data = &found.mean[0][0], .width = WIDTH, .height = HEIGHT, .channels = 3};
    dpl_output cosine = {.data = &found.cosine[0][0], .width = WIDTH, .height = HEIGHT, .channels = 4};
    dpl_output sine = {.data = &found.sine[0][0], .width = WIDTH, .height = HEIGHT, .channels = 3};
    assert_ok(dpl_solver_solve_directional(solver, field, &mean, &cosine, &sine));
    dpl_solver_destroy(solver);
}

static void half_of_the_sky_gives_one_over_pi(void **state) {
    (void)state;
    /* Lit quarters from, to; and the expected coefficients times pi. */
    static const struct {
        int from, to;
        double cosine, sine;
    } cases[] = {{0, 2, 0.0, 1.0}, {1, 3, -1.0, 0.0}, {2, 4, 0.0, -1.0}, {0, 1, 0.5, 0.5}, {0, 4, 0.0, 0.0}};
    dpl_field *field = truth_field(WIDTH, HEIGHT, 0);
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        truth_sky_quarters(field, cases[i].from, cases[i].to, 1.0f);
        solve(field, 4096, 0);
        for (int32_t p = 0; p < PIXELS; p += 17) {
            truth_assert_near((double)found.mean[p][1], (cases[i].to - cases[i].from) / 4.0, 1e-6);
            truth_assert_near((double)found.cosine[p][1], cases[i].cosine / TRUTH_PI, 1e-6);
            truth_assert_near((double)found.sine[p][1], cases[i].sine / TRUTH_PI, 1e-6);
            assert_true(found.cosine[p][3] == 1.0f);
        }
    }
    dpl_field_destroy(field);
}

static void the_vector_points_to_the_lamp(void **state) {
    (void)state;
    /* A lamp of half angle a in the direction t gives (cos t, sin t) sin(a) / pi. */
    dpl_field *field = truth_field(WIDTH, HEIGHT, 0);
    truth_box(field, 24, 8, 25, 11, truth_wall(1.0, 0.0));
    solve(field, 4096, 0);
    double half = atan2(1.5, 24.0 - 4.5);
    int32_t at = 9 * WIDTH + 4;
    truth_assert_near((double)found.cosine[at][0], sin(half) / TRUTH_PI, 1.0 / 4096);
    truth_assert_near((double)found.sine[at][0], 0.0, 1e-6);
    assert_true(found.cosine[9 * WIDTH + 28][0] < -0.02f); /* from its right side the lamp is to the left */
    assert_true(found.sine[2 * WIDTH + 24][0] > 0.02f);    /* from above it is below: +y */
    assert_true(found.sine[17 * WIDTH + 24][0] < -0.02f);  /* from below it is above */
    assert_true(found.mean[9 * WIDTH + 24][0] == 1.0f);    /* inside it shows itself ... */
    assert_true(!(fabsf(found.cosine[9 * WIDTH + 24][0]) > 0)); /* ... and nothing arrives */
    assert_true(!(fabsf(found.sine[9 * WIDTH + 24][0]) > 0));
    dpl_field_destroy(field);
}

static void the_mean_is_that_of_a_plain_solve(void **state) {
    (void)state;
    static float plain[PIXELS][3];
    dpl_field *field = truth_field(WIDTH, HEIGHT, 3);
    truth_sky_quarters(field, 2, 3, 0.5f);
    truth_box(field, 24, 8, 25, 11, truth_wall(1.0, 0.4));
    truth_box(field, 4, 4, 20, 6, truth_wall(0.0, 0.8));
    for (int32_t bounces = 0; bounces < 3; bounces++) {
        solve(field, 64, bounces);
        truth_solve(field, 64, bounces, &plain[0][0]);
        assert_memory_equal(plain, found.mean, sizeof plain);
    }
    dpl_field_destroy(field);
}

static void who_cannot_tell_says_so(void **state) {
    (void)state;
    dpl_field *field = truth_field(WIDTH, HEIGHT, 0);
    dpl_solver_desc desc = dpl_solver_desc_default();
    dpl_solver *solver;
    desc.kind = DPL_SOLVER_CASCADES;
    dpl_output good = {.data = &found.mean[0][0], .width = WIDTH, .height = HEIGHT, .channels = 3};
    dpl_output cosine = {.data = &found.cosine[0][0], .width = WIDTH, .height = HEIGHT, .channels = 4},
               small = good, empty = good;
    small.width--;
    empty.data = NULL;
    assert_ok(dpl_solver_create(context, &desc, &solver));
    assert_int_equal(dpl_solver_solve_directional(solver, field, &good, &cosine, &good), DPL_ERROR_ARGUMENT);
    assert_string_equal(dpl_context_message(context), "cascades: there is no directional output");
    dpl_solver_destroy(solver);
    solver = truth_solver(8, 0);
    assert_int_equal(dpl_solver_solve_directional(solver, field, &good, &small, &good), DPL_ERROR_SIZE);
    assert_int_equal(dpl_solver_solve_directional(solver, field, &good, &good, &empty), DPL_ERROR_ARGUMENT);
    assert_int_equal(dpl_solver_solve_directional(solver, field, &good, NULL, &good), DPL_ERROR_ARGUMENT);
    dpl_solver_destroy(solver);
    dpl_field_destroy(field);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(half_of_the_sky_gives_one_over_pi),
        cmocka_unit_test(the_vector_points_to_the_lamp),
        cmocka_unit_test(the_mean_is_that_of_a_plain_solve),
        cmocka_unit_test(who_cannot_tell_says_so),
    };
    return cmocka_run_group_tests(tests, open_context, close_context);
}
