/* Light between walls, in the reference: closed forms, what must not leak, and what must only ever grow. */
#include "truth.h"

enum { WIDTH = 36, HEIGHT = 28, PIXELS = WIDTH * HEIGHT };

static float now[PIXELS][3], before[PIXELS][3];

static const float *light_at(int32_t x, int32_t y) {
    return now[y * WIDTH + x];
}

/* A room whose walls, and a block in it, are all of one material. */
static dpl_field *open_room(dpl_material wall) {
    dpl_field *field = truth_field(WIDTH, HEIGHT, 0);
    truth_box(field, 0, 0, WIDTH, HEIGHT, wall);
    truth_box(field, 2, 3, WIDTH - 1, HEIGHT - 2, truth_air());
    truth_box(field, 12, 9, 19, 16, wall);
    return field;
}

static void a_furnace_holds_the_sum_of_its_bounces(void **state) {
    (void)state;
    static const double albedos[] = {0.5, 0.9};
    for (int a = 0; a < 2; a++) {
        dpl_field *field = open_room(truth_wall(1.5, albedos[a]));
        double sum = 0.0;
        for (int n = 0; n <= 8; n++) {
            sum += 1.5 * pow((double)(float)albedos[a], n);
            truth_solve(field, 96, n, &now[0][0]);
            for (int32_t y = 3; y < HEIGHT - 2; y++) /* the blocks' faces show the same light as the air */
                for (int32_t x = 2; x < WIDTH - 1; x++)
                    if (x < 13 || x > 17 || y < 10 || y > 14)
                        truth_assert_close((double)light_at(x, y)[1], sum, 1e-6);
        }
        dpl_field_destroy(field);
    }
}

static void a_furnace_is_exact_for_every_number_of_directions(void **state) {
    (void)state;
    dpl_field *field = open_room(truth_wall(1.0, 0.5));
    for (int32_t directions = 4; directions < 20; directions++) {
        truth_solve(field, directions, 3, &now[0][0]);
        truth_assert_close((double)light_at(25, 20)[0], 1.875, 1e-6);
    }
    dpl_field_destroy(field);
}

static void a_white_block_cannot_be_told_from_the_sky(void **state) {
    (void)state;
    static const float sky[3] = {0.25f, 0.5f, 2.0f};
    dpl_field *field = truth_field(WIDTH, HEIGHT, 0);
    assert_ok(dpl_field_set_sky(field, sky));
    truth_box(field, 10, 8, 20, 17, truth_wall(0.0, 1.0));
    for (int n = 1; n <= 3; n += 2) {
        truth_solve(field, 128, n, &now[0][0]);
        for (int32_t i = 0; i < PIXELS; i++) {
            bool inner = i % WIDTH > 10 && i % WIDTH < 19 && i / WIDTH > 8 && i / WIDTH < 16;
            for (int c = 0; c < 3; c++)
                truth_assert_close((double)now[i][c], inner ? 0.0 : (double)sky[c], 1e-6);
        }
    }
    dpl_field_destroy(field);
}

static void a_lit_face_shows_by_the_angle_it_fills(void **state) {
    (void)state;
    /* The sky shines from the left half alone, and a block's left face looks at just that half. */
    dpl_field *field = truth_field(WIDTH, HEIGHT, 0);
    truth_sky_quarters(field, 1, 3, 1.0f);
    truth_box(field, 20, 6, 26, 21, truth_wall(0.0, 0.6));
    truth_solve(field, 4096, 0, &before[0][0]);
    truth_solve(field, 4096, 1, &now[0][0]);
    for (int32_t x = 0; x < 20; x += 3) {
        double angle = 2.0 * atan2(7.5, 20.0 - (x + 0.5));
        truth_assert_near((double)before[13 * WIDTH + x][0], 0.5, 1e-6);
        truth_assert_near((double)light_at(x, 13)[0], 0.5 + 0.6 * angle / (2.0 * TRUTH_PI),
                          0.6 / 4096 + 1e-6);
    }
    /* Inside the block a pixel shows the mean of its exposed faces: alone on the left edge, the lit face; at
     * the corner, that and the upper one, half of whose half circle is lit. */
    truth_assert_close((double)light_at(20, 13)[2], 0.6, 1e-6);
    truth_assert_close((double)light_at(20, 6)[2], (0.6 + 0.3) / 2.0, 1e-6);
    assert_true(light_at(25, 13)[2] == 0.0f && light_at(22, 13)[2] == 0.0f);
    dpl_field_destroy(field);
}

static void a_wall_of_one_pixel_does_not_leak(void **state) {
    (void)state;
    dpl_field *field = open_room(truth_wall(0.0, 0.8));
    truth_box(field, 12, 9, 19, 16, truth_air());
    truth_box(field, 17, 0, 18, HEIGHT, truth_wall(0.0, 0.8));
    truth_box(field, 6, 8, 9, 11, truth_wall(3.0, 0.1));
    truth_solve(field, 64, 0, &before[0][0]);
    truth_solve(field, 64, 4, &now[0][0]);
    for (int32_t y = 3; y < HEIGHT - 2; y++) {
        for (int32_t x = 18; x < WIDTH - 1; x++)
            assert_true(light_at(x, y)[0] == 0.0f);
        assert_true(light_at(16, y)[0] > 1.2f * before[y * WIDTH + 16][0]);
        assert_true(light_at(17, y)[0] > 0.0f); /* the mean of its bright face and its dark one */
    }
    dpl_field_destroy(field);
}

static void reflected_light_has_the_colour_of_the_paint(void **state) {
    (void)state;
    dpl_material paint = truth_wall(0.0, 0.0);
    paint.albedo[0] = 0.8f;
    paint.albedo[1] = 0.4f;
    dpl_field *field = truth_field(WIDTH, HEIGHT, 0);
    truth_sky_quarters(field, 1, 3, 1.0f);
    truth_box(field, 20, 6, 26, 21, paint);
    truth_solve(field, 256, 0, &before[0][0]);
    truth_solve(field, 256, 1, &now[0][0]);
    for (int32_t x = 0; x < 20; x += 4) {
        const float *unlit = before[13 * WIDTH + x], *lit = light_at(x, 13);
        double red = (double)(lit[0] - unlit[0]), green = (double)(lit[1] - unlit[1]);
        assert_true(red > 0.01);
        truth_assert_close(green, 0.5 * red, 1e-4);
        assert_true(!(lit[2] > unlit[2]) && !(lit[2] < unlit[2]));
    }
    dpl_field_destroy(field);
}

/* A world of everything: lamps, fog and paint at random. */
static dpl_field *open_clutter(uint32_t seed) {
    dpl_field *field = truth_field(WIDTH, HEIGHT, 0);
    truth_sky_quarters(field, 0, 1, 0.3f);
    for (int i = 0; i < 60; i++) {
        seed = seed * 1664525u + 1013904223u;
        double x = seed >> 10 & 31, y = (seed >> 16 & 63) % HEIGHT;
        dpl_material material = truth_wall(i % 7 == 0 ? 2.0 : 0.0, (seed >> 22 & 7) / 8.0);
        for (int c = 0; c < 3 && i % 5 == 0; c++)
            material.extinction[c] = 0.1f * (float)c;
        truth_box(field, x, y, x + 1 + (seed >> 25 & 3), y + 1 + (seed >> 28 & 3), material);
    }
    return field;
}

static void a_bounce_makes_no_pixel_darker(void **state) {
    (void)state;
    dpl_field *field = open_clutter(5);
    truth_solve(field, 64, 0, &before[0][0]);
    for (int n = 1; n <= 8; n++) {
        double gain = 0.0;
        truth_solve(field, 64, n, &now[0][0]);
        for (int32_t i = 0; i < PIXELS; i++)
            for (int c = 0; c < 3; c++) {
                assert_true(now[i][c] >= before[i][c]);
                gain += (double)(now[i][c] - before[i][c]);
            }
        assert_true(gain > 0.0);
        memcpy(before, now, sizeof now);
    }
    dpl_field_destroy(field);
}

static void paint_in_the_air_and_on_the_border_does_nothing(void **state) {
    (void)state;
    /* Fog with albedo does not scatter; walls whose only free side is outside the world reflect nothing. */
    dpl_material fog = truth_wall(0.0, 0.9), wall = truth_wall(1.0, 0.0);
    for (int c = 0; c < 3; c++)
        fog.extinction[c] = 0.05f;
    dpl_field *field = open_room(wall);
    truth_box(field, 4, 5, 10, 20, fog);
    truth_box(field, 0, 0, WIDTH, 1, truth_wall(1.0, 0.9));
    truth_solve(field, 64, 0, &before[0][0]);
    truth_solve(field, 64, 3, &now[0][0]);
    assert_memory_equal(before, now, sizeof now);
    dpl_field_destroy(field);
}

static void chosen_pixels_and_the_picture_agree(void **state) {
    (void)state;
    static const int32_t pixels[][2] = {{0, 0}, {35, 27}, {17, 13}, {3, 20}, {30, 2}};
    enum { COUNT = sizeof pixels / sizeof pixels[0] };
    float chosen[COUNT][3];
    dpl_field *field = open_clutter(9);
    dpl_solver *solver = truth_solver(64, 2);
    assert_ok(dpl_reference_solve_pixels(solver, field, pixels, COUNT, chosen));
    truth_solve(field, 64, 2, &now[0][0]);
    for (int i = 0; i < COUNT; i++)
        assert_memory_equal(chosen[i], light_at(pixels[i][0], pixels[i][1]), sizeof chosen[i]);
    dpl_solver_destroy(solver);
    dpl_field_destroy(field);
}

/* ---- work ----------------------------------------------------------------------------------------- */

static void rays_of_faces_are_counted(void **state) {
    (void)state;
    dpl_solver_stats stats;
    dpl_field *field = truth_field(WIDTH, HEIGHT, 0);
    truth_box(field, 10, 10, 13, 12, truth_wall(0.0, 0.5));
    dpl_solver *solver = truth_solver(64, 3);
    dpl_output output = {.data = &now[0][0], .width = WIDTH, .height = HEIGHT, .channels = 3};
    assert_ok(dpl_solver_solve(solver, field, &output));
    dpl_solver_read_stats(solver, &stats);
    assert_int_equal(stats.level_count, 2);
    assert_int_equal(stats.levels[0].traced, (PIXELS - 6) * 64);
    assert_int_equal(stats.levels[1].probes, 3 * 10);
    assert_int_equal(stats.levels[1].traced, 3 * 10 * 32);
    assert_int_equal(stats.rays_traced, stats.levels[0].traced + stats.levels[1].traced);
    dpl_solver_destroy(solver);
    dpl_field_destroy(field);
}

typedef struct watch {
    double last;
    double stop_at;
    int calls;
} watch;

static int watch_progress(double done, void *user) {
    watch *w = user;
    assert_true(done >= w->last && done <= 1.000001);
    w->last = done;
    w->calls++;
    return done < w->stop_at;
}

static void every_pass_reports_progress_and_can_be_cancelled(void **state) {
    (void)state;
    dpl_field *field = open_clutter(3);
    truth_solve(field, 32, 4, &before[0][0]);
    dpl_solver_desc desc = dpl_solver_desc_default();
    watch w = {0};
    desc.kind = DPL_SOLVER_REFERENCE;
    desc.reference.directions = 32;
    desc.bounces = 4;
    desc.progress = watch_progress;
    desc.progress_user = &w;
    dpl_solver *solver;
    assert_ok(dpl_solver_create(context, &desc, &solver));
    dpl_output output = {.data = &now[0][0], .width = WIDTH, .height = HEIGHT, .channels = 3};
    memset(now, 0, sizeof now);
    for (double stop = 0.0; stop < 0.99; stop += 0.07) { /* in every pass, and between */
        w = (watch){.stop_at = stop};
        assert_int_equal(dpl_solver_solve(solver, field, &output), DPL_ERROR_CANCELLED);
        assert_true(now[100][0] == 0.0f && w.calls > 0);
    }
    w = (watch){.stop_at = 2.0};
    assert_ok(dpl_solver_solve(solver, field, &output));
    assert_true(w.last > 0.999 && w.calls > 100);
    assert_memory_equal(before, now, sizeof now);
    dpl_solver_destroy(solver);
    dpl_field_destroy(field);
}

static void bounces_out_of_range_are_refused(void **state) {
    (void)state;
    static const struct {
        dpl_solver_kind kind;
        int32_t bounces;
        const char *text;
    } cases[] = {
        {DPL_SOLVER_REFERENCE, -1, "bounces must be 0 .. 8, not -1"},
        {DPL_SOLVER_REFERENCE, 9, "bounces must be 0 .. 8, not 9"},
        {DPL_SOLVER_CASCADES, 1, "cascades: light does not bounce here: bounces must be 0"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        dpl_solver_desc desc = dpl_solver_desc_default();
        dpl_solver *solver;
        desc.kind = cases[i].kind;
        desc.bounces = cases[i].bounces;
        assert_int_equal(dpl_solver_create(context, &desc, &solver), DPL_ERROR_ARGUMENT);
        assert_null(solver);
        assert_string_equal(dpl_context_message(context), cases[i].text);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_furnace_holds_the_sum_of_its_bounces),
        cmocka_unit_test(a_furnace_is_exact_for_every_number_of_directions),
        cmocka_unit_test(a_white_block_cannot_be_told_from_the_sky),
        cmocka_unit_test(a_lit_face_shows_by_the_angle_it_fills),
        cmocka_unit_test(a_wall_of_one_pixel_does_not_leak),
        cmocka_unit_test(reflected_light_has_the_colour_of_the_paint),
        cmocka_unit_test(a_bounce_makes_no_pixel_darker),
        cmocka_unit_test(paint_in_the_air_and_on_the_border_does_nothing),
        cmocka_unit_test(chosen_pixels_and_the_picture_agree),
        cmocka_unit_test(rays_of_faces_are_counted),
        cmocka_unit_test(every_pass_reports_progress_and_can_be_cancelled),
        cmocka_unit_test(bounces_out_of_range_are_refused),
    };
    return cmocka_run_group_tests(tests, open_context, close_context);
}
