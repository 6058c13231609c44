/* Walls reflect lights: each light exactly once, directly and by way of walls, in both solvers that bounce.
 */
#include "counting.h"
#include "holographic.h"

#include <dapple/dapple.h>

#include <stdlib.h>

enum { WIDTH = 64, HEIGHT = 48, PIXELS = WIDTH * HEIGHT };

static dpl_light light_at(double x, double y, double radius, double radiance) {
    return (dpl_light){{x, y}, radius, {1.0f, 0.5f, 0.25f}, (float)radiance};
}

static dpl_solver *solver_with(dpl_solver_kind kind, int32_t bounces, int32_t directions) {
    dpl_solver_desc desc = dpl_solver_desc_default();
    dpl_solver *solver;
    desc.kind = kind;
    desc.reference.directions = directions;
    desc.bounces = bounces;
    assert_ok(dpl_solver_create(context, &desc, &solver));
    return solver;
}

static dpl_solver *solver_of(dpl_solver_kind kind, int32_t bounces) {
    return solver_with(kind, bounces, 64);
}

/* What a solver makes of a field and lights, malloc'ed. */
static float *solve(dpl_field *field, dpl_solver_kind kind, int32_t bounces, const dpl_light *lights,
                    int32_t count) {
    dpl_solver *solver = solver_of(kind, bounces);
    assert_ok(dpl_solver_set_lights(solver, lights, count));
    float *rgb = hrc_solve_with(solver, field);
    dpl_solver_destroy(solver);
    return rgb;
}

/* What lights give directly, malloc'ed. */
static float *shine(dpl_field *field, const dpl_light *lights, int32_t count) {
    float *rgb = malloc(hrc_values(field) * sizeof *rgb);
    dpl_shadow_desc desc = dpl_shadow_desc_default();
    dpl_shadow *shadow;
    assert_non_null(rgb);
    dpl_output output = hrc_output(field, rgb);
    assert_ok(dpl_shadow_create(context, &desc, &shadow));
    assert_ok(dpl_shadow_light(shadow, field, lights, count, &output));
    dpl_shadow_destroy(shadow);
    return rgb;
}

/* Painted walls and blocks in the open, and a border that is not closed. */
static dpl_field *open_yard(int32_t margin) {
    dpl_field *field = truth_field(WIDTH, HEIGHT, margin);
    truth_box(field, 4, 4, 8, 44, truth_wall(0.0, 0.9));
    truth_box(field, 8, 4, 50, 7, truth_wall(0.0, 0.8));
    truth_box(field, 8, 41, 50, 44, truth_wall(0.0, 0.7));
    truth_box(field, 24, 20, 34, 28, truth_wall(0.0, 0.5));
    return field;
}

/* ---- exactly once --------------------------------------------------------------------------------- */

enum { CHOSEN = 40, MARGIN = 120, RADIUS = 40 };

static void choose_pixels(int32_t pixels[CHOSEN][2]) {
    for (int32_t i = 0; i < CHOSEN; i++) {
        pixels[i][0] = i * 37 % WIDTH;
        pixels[i][1] = i * 29 % HEIGHT;
    }
}

/* The truth at chosen pixels. */
static void solve_chosen(dpl_field *field, int32_t bounces, const dpl_light *lights, int32_t count,
                         float rgb[CHOSEN][3]) {
    int32_t pixels[CHOSEN][2];
    dpl_solver *solver = solver_with(DPL_SOLVER_REFERENCE, bounces, 1024);
    choose_pixels(pixels);
    assert_ok(dpl_solver_set_lights(solver, lights, count));
    assert_ok(dpl_reference_solve_pixels(solver, field, (const int32_t(*)[2])pixels, CHOSEN, rgb));
    dpl_solver_destroy(solver);
}

/* A light outside the picture, behind which nothing shines: then an opaque disc of that emission hides
 * nothing, and the two worlds are the same but for the steps of the disc's outline. */
static void direct_and_reflected_light_are_that_of_an_emitting_disc(void **state) {
    (void)state;
    static const double at[2] = {WIDTH + 70, 20};
    dpl_light light = light_at(at[0], at[1], RADIUS, 2.0);
    dpl_shape disc = dpl_shape_default(DPL_SHAPE_DISC);
    disc.disc = (dpl_disc){{at[0], at[1]}, RADIUS - 0.3}; /* corners of its pixels reach beyond */
    for (int c = 0; c < 3; c++)
        disc.material.emission[c] = light.color[c] * light.intensity;
    dpl_field *field = open_yard(MARGIN), *lamp = open_yard(MARGIN);
    assert_ok(dpl_field_draw_shapes(lamp, &disc, 1));
    float *direct = shine(field, &light, 1);
    for (int32_t bounces = 0; bounces <= 2; bounces += 2) {
        float with[CHOSEN][3], wanted[CHOSEN][3];
        int32_t pixels[CHOSEN][2];
        double error = 0.0, sum = 0.0, reflected = 0.0;
        choose_pixels(pixels);
        solve_chosen(field, bounces, &light, 1, with);
        solve_chosen(lamp, bounces, NULL, 0, wanted);
        for (int i = 0; i < CHOSEN; i++)
            for (int c = 0; c < 3; c++) {
                double once = (double)direct[3 * (pixels[i][1] * WIDTH + pixels[i][0]) + c];
                error += pow(once + (double)with[i][c] - (double)wanted[i][c], 2.0);
                sum += (double)wanted[i][c];
                reflected += (double)with[i][c];
            }
        assert_true(sqrt(error * 3 * CHOSEN) < 0.015 * sum); /* measured: 1.1 and 0.9 % */
        assert_true(bounces == 0 ? !(reflected > 0.0) : reflected > 0.1 * sum);
    }
    free(direct);
    dpl_field_destroy(field);
    dpl_field_destroy(lamp);
}

/* ---- closed form ---------------------------------------------------------------------------------- */

/* A face sees a disc whole, at an angle; the opaque pixel shows what its one lit face sends out. */
static void a_face_sends_out_what_a_disc_gives_it(void **state) {
    (void)state;
    static const dpl_solver_kind kinds[] = {DPL_SOLVER_REFERENCE, DPL_SOLVER_HOLOGRAPHIC};
    static const double places[][3] = {{40, 24.5, 6}, {30, 10, 4}, {22, 40, 3}, {21.5, 24, 15}, {20.5, 5, 3}};
    for (int k = 0; k < 2; k++)
        for (size_t i = 0; i < sizeof places / sizeof places[0]; i++) {
            dpl_light light = light_at(places[i][0], places[i][1], places[i][2], 3.0);
            dpl_field *field = truth_field(WIDTH, HEIGHT, 0);
            truth_box(field, 10, 20, 20, 30, truth_wall(0.0, 0.6));
            float *rgb = solve(field, kinds[k], 1, &light, 1);
            double x = light.position[0] - 20.5, y = light.position[1] - 25.5, share = 1.0;
            if (hypot(x, y) > light.radius) {
                double middle = atan2(y, x), half = asin(light.radius / hypot(x, y));
                share =
                    0.5 * (sin(fmin(middle + half, TRUTH_PI / 2)) - sin(fmax(middle - half, -TRUTH_PI / 2)));
            }
            truth_assert_close((double)rgb[3 * (25 * WIDTH + 19)], 0.6 * 3.0 * share, k ? 1e-5 : 2e-3);
            truth_assert_close((double)rgb[3 * (25 * WIDTH + 19) + 1], 0.3 * 3.0 * share, k ? 1e-5 : 2e-3);
            free(rgb);
            dpl_field_destroy(field);
        }
}

static void fog_takes_its_share_on_the_way_to_a_face(void **state) {
    (void)state;
    static const dpl_solver_kind kinds[] = {DPL_SOLVER_REFERENCE, DPL_SOLVER_HOLOGRAPHIC};
    dpl_light light = light_at(50, 25.5, 1, 3.0);
    for (int k = 0; k < 2; k++) {
        dpl_field *clear = truth_field(WIDTH, HEIGHT, 0), *foggy = truth_field(WIDTH, HEIGHT, 0);
        truth_box(clear, 10, 20, 20, 30, truth_wall(0.0, 0.6));
        truth_box(foggy, 10, 20, 20, 30, truth_wall(0.0, 0.6));
        truth_box(foggy, 30, 0, 40, HEIGHT, hrc_fog(0.0, 0.01, 0.02, 0.05));
        float *a = solve(clear, kinds[k], 1, &light, 1), *b = solve(foggy, kinds[k], 1, &light, 1);
        for (int c = 0; c < 3; c++)
            truth_assert_close((double)b[3 * (25 * WIDTH + 19) + c] / (double)a[3 * (25 * WIDTH + 19) + c],
                               exp(-10.0 * (c == 0   ? 0.01
                                            : c == 1 ? 0.02
                                                     : 0.05)),
                               1e-3);
        free(a);
        free(b);
        dpl_field_destroy(clear);
        dpl_field_destroy(foggy);
    }
}

/* ---- the holographic solver ----------------------------------------------------------------------- */

static dpl_field *furnished_room(void) {
    dpl_field *field = truth_field(WIDTH, HEIGHT, 0);
    truth_box(field, 0, 0, WIDTH, HEIGHT, truth_wall(0.0, 0.8));
    truth_box(field, 3, 3, WIDTH - 3, HEIGHT - 3, truth_air());
    truth_box(field, 20, 14, 26, 36, truth_wall(0.0, 0.6));
    truth_box(field, 40, 3, 43, 20, truth_wall(0.0, 0.7));
    truth_box(field, 52, 36, 56, 40, truth_wall(1.5, 0.5));
    return field;
}

static const dpl_light room_lights[2] = {
    {{12.0, 20.0}, 4.0, {1.0f, 0.8f, 0.6f}, 4.0f},
    {{33.0, 38.0}, 2.5, {0.2f, 0.5f, 1.0f}, 6.0f},
};

static void both_solvers_agree_on_a_room(void **state) {
    (void)state;
    dpl_field *field = furnished_room();
    for (int32_t bounces = 1; bounces <= 4; bounces += 3) {
        float *truth = solve(field, DPL_SOLVER_REFERENCE, bounces, room_lights, 2),
              *quick = solve(field, DPL_SOLVER_HOLOGRAPHIC, bounces, room_lights, 2),
              *unlit = solve(field, DPL_SOLVER_HOLOGRAPHIC, bounces, NULL, 0);
        assert_true(hrc_error(field, quick, truth) < 0.03); /* measured: 0.022 and 0.010 */
        assert_true(hrc_error(field, unlit, truth) > 0.3);
        free(truth);
        free(quick);
        free(unlit);
    }
    dpl_field_destroy(field);
}

static float *solve_at(dpl_field *field, dpl_resolution resolution, dpl_storage storage) {
    dpl_solver_desc desc = dpl_solver_desc_default();
    dpl_solver *solver;
    desc.holographic.resolution = resolution;
    desc.holographic.storage = storage;
    desc.bounces = 2;
    assert_ok(dpl_solver_create(context, &desc, &solver));
    assert_ok(dpl_solver_set_lights(solver, room_lights, 2));
    float *rgb = hrc_solve_with(solver, field);
    dpl_solver_destroy(solver);
    return rgb;
}

static void every_resolution_and_storage_reflects_them(void **state) {
    (void)state;
    static const struct {
        dpl_resolution resolution;
        dpl_storage storage;
        double bound;
    } cases[] = {
        {DPL_RESOLUTION_FULL, DPL_STORAGE_HALF, 0.01},
        {DPL_RESOLUTION_DOUBLE, DPL_STORAGE_FLOAT, 0.04},
        {DPL_RESOLUTION_HALF, DPL_STORAGE_FLOAT, 0.12},
        {DPL_RESOLUTION_QUARTER, DPL_STORAGE_FLOAT, 0.25},
    };
    dpl_field *field = furnished_room();
    float *full = solve_at(field, DPL_RESOLUTION_FULL, DPL_STORAGE_FLOAT);
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        float *rgb = solve_at(field, cases[i].resolution, cases[i].storage);
        assert_true(hrc_error(field, rgb, full) < cases[i].bound);
        free(rgb);
    }
    free(full);
    dpl_field_destroy(field);
}

/* ---- what must be the same ------------------------------------------------------------------------ */

static void without_bounces_lights_change_no_byte(void **state) {
    (void)state;
    static const dpl_solver_kind kinds[] = {DPL_SOLVER_REFERENCE, DPL_SOLVER_HOLOGRAPHIC,
                                            DPL_SOLVER_CASCADES};
    dpl_field *field = furnished_room();
    for (int k = 0; k < 3; k++) {
        float *with = solve(field, kinds[k], 0, room_lights, 2),
              *without = solve(field, kinds[k], 0, NULL, 0);
        assert_memory_equal(with, without, hrc_values(field) * sizeof *with);
        free(with);
        free(without);
    }
    dpl_field_destroy(field);
}

static void lights_are_replaced_and_taken_away(void **state) {
    (void)state;
    static const dpl_solver_kind kinds[] = {DPL_SOLVER_REFERENCE, DPL_SOLVER_HOLOGRAPHIC};
    dpl_field *field = furnished_room();
    size_t bytes = hrc_values(field) * sizeof(float);
    for (int k = 0; k < 2; k++) {
        dpl_solver *solver = solver_of(kinds[k], 1);
        assert_ok(dpl_solver_set_lights(solver, room_lights, 2));
        float *both = hrc_solve_with(solver, field);
        assert_ok(dpl_solver_set_lights(solver, &room_lights[1], 1));
        float *second = hrc_solve_with(solver, field);
        assert_ok(dpl_solver_set_lights(solver, NULL, 0));
        float *none = hrc_solve_with(solver, field);
        float *first = solve(field, kinds[k], 1, room_lights, 1), *unlit = solve(field, kinds[k], 1, NULL, 0);
        assert_memory_equal(none, unlit, bytes);
        for (size_t i = 0; i < hrc_values(field); i++) /* light adds up */
            truth_assert_near((double)both[i], (double)first[i] + (double)second[i] - (double)none[i],
                              1e-5 * (1.0 + (double)both[i]));
        free(both);
        free(second);
        free(none);
        free(first);
        free(unlit);
        dpl_solver_destroy(solver);
    }
    dpl_field_destroy(field);
}

/* What changes with the lights is solved again; the same lights once more are no change. */
static void kept_frames_know_their_lights(void **state) {
    (void)state;
    dpl_field *field = furnished_room();
    size_t bytes = hrc_values(field) * sizeof(float);
    dpl_solver_desc desc = dpl_solver_desc_default();
    dpl_solver *solver;
    desc.bounces = 1;
    desc.reuse = 1;
    assert_ok(dpl_solver_create(context, &desc, &solver));
    static const int32_t frames[] = {0, 2, 2, 1, 0};
    for (size_t i = 0; i < sizeof frames / sizeof frames[0]; i++) {
        assert_ok(dpl_solver_set_lights(solver, room_lights, frames[i]));
        float *kept = hrc_solve_with(solver, field);
        float *anew = solve(field, DPL_SOLVER_HOLOGRAPHIC, 1, room_lights, frames[i]);
        assert_memory_equal(kept, anew, bytes);
        free(kept);
        free(anew);
    }
    dpl_solver_destroy(solver);
    dpl_field_destroy(field);
}

/* A margin moves the world's origin, not the lights. */
static void lights_stand_in_the_picture_whatever_the_margin(void **state) {
    (void)state;
    static const dpl_solver_kind kinds[] = {DPL_SOLVER_REFERENCE, DPL_SOLVER_HOLOGRAPHIC};
    dpl_light light = light_at(58, 24, 3, 5.0);
    for (int k = 0; k < 2; k++) {
        dpl_field *field = open_yard(0), *wider = open_yard(16);
        float *a = solve(field, kinds[k], 2, &light, 1), *b = solve(wider, kinds[k], 2, &light, 1);
        assert_true(hrc_error(field, b, a) < (k ? 0.02 : 1e-6));
        free(a);
        free(b);
        dpl_field_destroy(field);
        dpl_field_destroy(wider);
    }
}

/* ---- work and errors ------------------------------------------------------------------------------ */

static void rays_to_lights_are_counted(void **state) {
    (void)state;
    dpl_solver_stats stats;
    dpl_field *field = truth_field(WIDTH, HEIGHT, 0);
    truth_box(field, 10, 10, 13, 12, truth_wall(0.0, 0.5));
    dpl_light light = light_at(40, 11, 1, 1.0); /* seen by the right faces alone, whole */
    dpl_solver *solver = solver_of(DPL_SOLVER_REFERENCE, 2);
    assert_ok(dpl_solver_set_lights(solver, &light, 1));
    free(hrc_solve_with(solver, field));
    dpl_solver_read_stats(solver, &stats);
    assert_int_equal(stats.level_count, 3);
    assert_int_equal(stats.levels[2].probes, 10);
    assert_int_equal(stats.levels[2].directions, 256);
    assert_true(stats.levels[2].traced >= 2 * 256 && stats.levels[2].traced < 10 * 256);
    dpl_solver_destroy(solver);
    dpl_field_destroy(field);
}

static void bad_lights_are_refused_and_the_old_ones_stay(void **state) {
    (void)state;
    dpl_field *field = furnished_room();
    dpl_solver *solver = solver_of(DPL_SOLVER_HOLOGRAPHIC, 1);
    dpl_light bad[2] = {room_lights[0], room_lights[1]};
    bad[1].radius = -1.0;
    assert_ok(dpl_solver_set_lights(solver, room_lights, 2));
    assert_int_equal(dpl_solver_set_lights(solver, bad, 2), DPL_ERROR_ARGUMENT);
    assert_string_equal(dpl_context_message(context), "light 1: the radius must be 0 .. 1e6");
    assert_int_equal(dpl_solver_set_lights(solver, NULL, 1), DPL_ERROR_ARGUMENT);
    assert_int_equal(dpl_solver_set_lights(solver, bad, -1), DPL_ERROR_ARGUMENT);
    assert_int_equal(dpl_solver_set_lights(NULL, bad, 0), DPL_ERROR_ARGUMENT);
    float *after = hrc_solve_with(solver, field),
          *before = solve(field, DPL_SOLVER_HOLOGRAPHIC, 1, room_lights, 2);
    assert_memory_equal(after, before, hrc_values(field) * sizeof *after);
    free(after);
    free(before);
    dpl_solver_destroy(solver);
    dpl_field_destroy(field);
}

/* A solve in a context of one thread, whose allocations are counted; lights move between two frames. */
static dpl_status solve_counted(counting *c, dpl_solver_kind kind, int *second_frame) {
    dpl_context_desc desc = dpl_context_desc_default();
    dpl_context *own;
    desc.thread_count = 1;
    desc.allocator = (dpl_allocator){count_allocate, count_release, c};
    dpl_status status = dpl_context_create(&desc, &own);
    if (status != DPL_OK)
        return status;
    static float rgb[PIXELS][3];
    dpl_field *field = NULL;
    dpl_solver *solver = NULL;
    dpl_field_desc size = dpl_field_desc_default();
    size.width = WIDTH;
    size.height = HEIGHT;
    dpl_shape wall = dpl_shape_default(DPL_SHAPE_BOX);
    wall.box = (dpl_box){{30, 20}, {8, 5}, 0.3};
    wall.material = truth_wall(0.0, 0.5);
    dpl_solver_desc solver_desc = dpl_solver_desc_default();
    solver_desc.kind = kind;
    solver_desc.bounces = 1;
    solver_desc.reference.directions = 8;
    dpl_output output = {.data = rgb, .width = WIDTH, .height = HEIGHT, .channels = 3};
    dpl_light lights[2] = {room_lights[0], room_lights[1]};
    status = dpl_field_create(own, &size, &field);
    status = status == DPL_OK ? dpl_field_draw_shapes(field, &wall, 1) : status;
    status = status == DPL_OK ? dpl_solver_create(own, &solver_desc, &solver) : status;
    status = status == DPL_OK ? dpl_solver_set_lights(solver, lights, 2) : status;
    status = status == DPL_OK ? dpl_solver_solve(solver, field, &output) : status;
    int before = c->allocations;
    lights[0].position[0] += 1.5;
    status = status == DPL_OK ? dpl_solver_set_lights(solver, lights, 2) : status;
    status = status == DPL_OK ? dpl_solver_solve(solver, field, &output) : status;
    *second_frame = c->allocations - before;
    dpl_solver_destroy(solver);
    dpl_field_destroy(field);
    dpl_context_destroy(own);
    return status;
}

static void frames_with_moving_lights_allocate_nothing_and_no_failure_leaks(void **state) {
    (void)state;
    static const dpl_solver_kind kinds[] = {DPL_SOLVER_REFERENCE, DPL_SOLVER_HOLOGRAPHIC};
    for (int k = 0; k < 2; k++) {
        counting all = {0};
        int second_frame;
        assert_ok(solve_counted(&all, kinds[k], &second_frame));
        assert_int_equal(second_frame, 0);
        assert_int_equal(all.live, 0);
        for (int i = 1; i <= all.allocations; i++) {
            counting c = {.fail_at = i};
            assert_int_equal(solve_counted(&c, kinds[k], &second_frame), DPL_ERROR_MEMORY);
            assert_int_equal(c.live, 0);
        }
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(direct_and_reflected_light_are_that_of_an_emitting_disc),
        cmocka_unit_test(a_face_sends_out_what_a_disc_gives_it),
        cmocka_unit_test(fog_takes_its_share_on_the_way_to_a_face),
        cmocka_unit_test(both_solvers_agree_on_a_room),
        cmocka_unit_test(every_resolution_and_storage_reflects_them),
        cmocka_unit_test(without_bounces_lights_change_no_byte),
        cmocka_unit_test(lights_are_replaced_and_taken_away),
        cmocka_unit_test(kept_frames_know_their_lights),
        cmocka_unit_test(lights_stand_in_the_picture_whatever_the_margin),
        cmocka_unit_test(rays_to_lights_are_counted),
        cmocka_unit_test(bad_lights_are_refused_and_the_old_ones_stay),
        cmocka_unit_test(frames_with_moving_lights_allocate_nothing_and_no_failure_leaks),
    };
    return cmocka_run_group_tests(tests, open_context, close_context);
}
