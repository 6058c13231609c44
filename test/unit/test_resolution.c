/* Light solved at another resolution than the picture's: what must hold whatever the grid. */
#include "world.h"

#include "truth.h"

#include <stdlib.h>

static const dpl_resolution resolutions[] = {DPL_RESOLUTION_FULL, DPL_RESOLUTION_HALF, DPL_RESOLUTION_QUARTER,
                                             DPL_RESOLUTION_DOUBLE};
enum { RESOLUTIONS = 4 };

static dpl_solver *solver_with(dpl_resolution resolution, dpl_storage storage, int32_t bounces) {
    dpl_solver_desc desc = dpl_solver_desc_default();
    dpl_solver *solver;
    desc.kind = DPL_SOLVER_HOLOGRAPHIC;
    desc.holographic.resolution = resolution;
    desc.holographic.storage = storage;
    desc.bounces = bounces;
    assert_ok(dpl_solver_create(context, &desc, &solver));
    return solver;
}

static dpl_solver *solver_at(dpl_resolution resolution, dpl_storage storage) {
    return solver_with(resolution, storage, 0);
}

/* The whole picture, tightly packed; free() it. */
static float *light_of(dpl_field *field, dpl_resolution resolution) {
    dpl_solver *solver = solver_at(resolution, DPL_STORAGE_FLOAT);
    int32_t width = dpl_field_width(field), height = dpl_field_height(field);
    float *rgb = malloc((size_t)width * (size_t)height * sizeof(float[3]));
    assert_non_null(rgb);
    dpl_output output = {.data = rgb, .width = width, .height = height, .channels = 3};
    assert_ok(dpl_solver_solve(solver, field, &output));
    dpl_solver_destroy(solver);
    return rgb;
}

static void a_resolution_that_does_not_exist_is_refused(void **state) {
    (void)state;
    dpl_solver_desc desc = dpl_solver_desc_default();
    dpl_solver *solver;
    desc.kind = DPL_SOLVER_HOLOGRAPHIC;
    desc.holographic.resolution = (dpl_resolution)4;
    assert_int_equal(dpl_solver_create(context, &desc, &solver), DPL_ERROR_ARGUMENT);
    assert_null(solver);
}

static void an_empty_world_of_any_size_shows_its_sky(void **state) {
    (void)state;
    static const int32_t sizes[][2] = {{1, 1}, {3, 5}, {2, 2}, {37, 4}, {1, 200}, {65, 33}};
    for (size_t i = 0; i < sizeof sizes / sizeof sizes[0]; i++)
        for (int r = 0; r < RESOLUTIONS; r++) {
            dpl_field *field = truth_field(sizes[i][0], sizes[i][1], (int32_t)i % 3);
            assert_ok(dpl_field_set_sky(field, (const float[3]){0.25f, 0.5f, 1.0f}));
            float *rgb = light_of(field, resolutions[r]);
            for (int32_t k = 0; k < sizes[i][0] * sizes[i][1] * 3; k++)
                truth_assert_close(rgb[k], k % 3 == 0 ? 0.25 : k % 3 == 1 ? 0.5 : 1.0, 1e-5);
            free(rgb);
            dpl_field_destroy(field);
        }
}

static void the_longest_world_is_solved(void **state) {
    (void)state;
    for (int r = 0; r < RESOLUTIONS; r++) {
        dpl_field *field = truth_field(1, DPL_MAX_SIZE, 0);
        truth_box(field, 0, 5000, 1, 5003, truth_wall(2.0, 0.0));
        float *rgb = light_of(field, resolutions[r]);
        assert_true(rgb[3 * 5001] == 2.0f);
        assert_true(rgb[3 * 4990] > 0.0f && rgb[3 * 5012] > 0.0f);
        free(rgb);
        dpl_field_destroy(field);
    }
}

static void an_opaque_world_shows_its_emission(void **state) {
    (void)state;
    for (int r = 0; r < RESOLUTIONS; r++) {
        dpl_field *field = truth_field(13, 7, 1);
        truth_box(field, -1, -1, 14, 8, truth_wall(0.75, 0.5));
        truth_box(field, 4, 2, 5, 3, truth_wall(3.0, 0.0));
        float *rgb = light_of(field, resolutions[r]);
        for (int32_t i = 0; i < 13 * 7; i++)
            assert_true(rgb[3 * i] == (i == 2 * 13 + 4 ? 3.0f : 0.75f));
        free(rgb);
        dpl_field_destroy(field);
    }
}

/* A wall one pixel wide crosses blocks at any of their rows; light must not. */
static void nothing_leaks_into_a_room_of_walls_one_pixel_wide(void **state) {
    (void)state;
    for (int r = 0; r < RESOLUTIONS; r++)
        for (int offset = 0; offset < 16; offset++) {
            dpl_field *field = truth_field(64, 64, 0);
            double x0 = 20 + offset % 4, y0 = 20 + offset / 4, x1 = x0 + 21, y1 = y0 + 18;
            assert_ok(dpl_field_set_sky(field, (const float[3]){1.0f, 1.0f, 1.0f}));
            truth_box(field, x0, y0, x1, y1, truth_wall(0.0, 0.0));
            truth_box(field, x0 + 1, y0 + 1, x1 - 1, y1 - 1, truth_air());
            float *rgb = light_of(field, resolutions[r]);
            for (int y = (int)y0 + 1; y < (int)y1 - 1; y++)
                for (int x = (int)x0 + 1; x < (int)x1 - 1; x++)
                    assert_true(rgb[3 * (y * 64 + x)] < 1e-5f);
            free(rgb);
            dpl_field_destroy(field);
        }
}

/* Walls whose pixels touch at corners alone. */
static void nothing_leaks_through_slanted_walls_one_pixel_wide(void **state) {
    (void)state;
    for (int r = 0; r < RESOLUTIONS; r++)
        for (int offset = 0; offset < 16; offset++) {
            dpl_field *field = truth_field(80, 80, 0);
            int cx = 38 + offset % 4, cy = 38 + offset / 4, radius = 20;
            assert_ok(dpl_field_set_sky(field, (const float[3]){1.0f, 1.0f, 1.0f}));
            for (int i = 0; i <= 2 * radius; i++) {
                int across = i < radius ? i : 2 * radius - i, x = cx - radius + i;
                truth_box(field, x, cy + across, x + 1, cy + across + 1, truth_wall(0.0, 0.0));
                truth_box(field, x, cy - across, x + 1, cy - across + 1, truth_wall(0.0, 0.0));
            }
            float *rgb = light_of(field, resolutions[r]);
            for (int y = 0; y < 80; y++)
                for (int x = 0; x < 80; x++)
                    if (abs(x - cx) + abs(y - cy) < radius)
                        assert_true(rgb[3 * (y * 80 + x)] < 1e-3f);
            free(rgb);
            dpl_field_destroy(field);
        }
}

static double mean_of(const float *rgb, int count) {
    double sum = 0.0;
    for (int i = 0; i < count; i++)
        sum += (double)rgb[3 * i];
    return sum / count;
}

/* It is a quarter of a block, or spread over four: on average over where it lies, its light must stay. */
static void a_lamp_of_two_pixels_shines_as_bright_wherever_it_lies(void **state) {
    (void)state;
    static const double tolerances[RESOLUTIONS] = {0.0, 0.15, 0.35, 0.05};
    double sums[RESOLUTIONS] = {0.0};
    for (int r = 0; r < RESOLUTIONS; r++)
        for (int offset = 0; offset < 16; offset++) {
            dpl_field *field = truth_field(64, 64, 0);
            double x = 30 + offset % 4, y = 30 + offset / 4;
            truth_box(field, x, y, x + 2, y + 2, truth_wall(1.0, 0.0));
            float *rgb = light_of(field, resolutions[r]);
            sums[r] += mean_of(rgb, 64 * 16); /* the rows above, 14 pixels away and more */
            free(rgb);
            dpl_field_destroy(field);
        }
    for (int r = 1; r < RESOLUTIONS; r++)
        truth_assert_close(sums[r], sums[0], tolerances[r]);
}

/* Where everything shines alike, so does what is made of it, however media are mixed. */
static void media_keep_their_brightness(void **state) {
    (void)state;
    for (int r = 0; r < RESOLUTIONS; r++) {
        dpl_field *field = truth_field(41, 35, 0);
        uint32_t seed = 5;
        assert_ok(dpl_field_set_sky(field, (const float[3]){0.5f, 0.5f, 0.5f}));
        for (int i = 0; i < 60; i++) {
            dpl_material medium = truth_wall(0.5, 0.0);
            double x = floor(dpl_test_random(&seed, 0, 41)), y = floor(dpl_test_random(&seed, 0, 35));
            for (int c = 0; c < 3; c++)
                medium.extinction[c] = i == 7 ? 1e30f : (float)dpl_test_random(&seed, 0.0, 3.0);
            truth_box(field, x, y, x + 1 + i % 5, y + 1 + i % 3, medium);
        }
        float *rgb = light_of(field, resolutions[r]);
        for (int i = 0; i < 41 * 35 * 3; i++)
            truth_assert_close(rgb[i], 0.5, 1e-4);
        free(rgb);
        dpl_field_destroy(field);
    }
}

/* A slab of fog lets through as much on every grid. */
static void fog_lets_through_as_much_as_at_full_resolution(void **state) {
    (void)state;
    double sums[RESOLUTIONS];
    for (int r = 0; r < RESOLUTIONS; r++) {
        dpl_field *field = truth_field(96, 96, 0);
        dpl_material fog = truth_wall(0.0, 0.0);
        fog.extinction[0] = fog.extinction[1] = fog.extinction[2] = 0.2f;
        truth_box(field, 0, 41, 96, 48, fog);
        truth_box(field, 0, 64, 96, 96, truth_wall(1.0, 0.0));
        float *rgb = light_of(field, resolutions[r]);
        sums[r] = mean_of(rgb, 96 * 32);
        free(rgb);
        dpl_field_destroy(field);
    }
    for (int r = 1; r < RESOLUTIONS; r++)
        truth_assert_close(sums[r], sums[0], r == 2 ? 0.06 : 0.03);
}

/* What is off-screen acts; what is shown is cut from the light of the whole world. */
static void a_margin_is_the_rim_of_a_larger_picture(void **state) {
    (void)state;
    for (int r = 0; r < RESOLUTIONS; r++)
        for (int32_t margin = 1; margin < 8; margin += 3) {
            int32_t width = 45, height = 38, whole_width = width + 2 * margin,
                    whole_height = height + 2 * margin;
            dpl_field *cut = truth_field(width, height, margin),
                      *whole = truth_field(whole_width, whole_height, 0);
            uint32_t seed = 3;
            for (int i = 0; i < 14; i++) {
                double x = dpl_test_random(&seed, -4, 45), y = dpl_test_random(&seed, -4, 38);
                dpl_material material = truth_wall(i % 3 ? 0.0 : 1.5, 0.0);
                truth_box(cut, x, y, x + 2 + i % 4, y + 5 - i % 4, material);
                truth_box(whole, x + margin, y + margin, x + margin + 2 + i % 4, y + margin + 5 - i % 4,
                          material);
            }
            float *a = light_of(cut, resolutions[r]), *b = light_of(whole, resolutions[r]);
            for (int32_t y = 0; y < height; y++)
                assert_memory_equal(a + (size_t)(y * width) * 3,
                                    b + (size_t)((y + margin) * whole_width + margin) * 3,
                                    (size_t)width * sizeof(float[3]));
            free(a);
            free(b);
            dpl_field_destroy(cut);
            dpl_field_destroy(whole);
        }
}

/* Relative rms error of free pixels. */
static double error_of(dpl_field *field, const float *test, const float *truth, int32_t count) {
    uint8_t *opaque = malloc((size_t)count);
    double squares = 0.0, sum = 0.0, pixels = 0.0;
    assert_non_null(opaque);
    assert_ok(dpl_field_read_opaque(field, opaque, 0));
    for (int32_t i = 0; i < 3 * count; i++) {
        if (opaque[i / 3])
            continue;
        double difference = (double)test[i] - (double)truth[i];
        squares += difference * difference;
        sum += (double)truth[i];
        pixels += 1.0;
    }
    free(opaque);
    return sqrt(squares / pixels) / (sum / pixels);
}

static void finer_grids_are_closer_to_the_truth(void **state) {
    (void)state;
    enum { SIZE = 128 };
    double errors[RESOLUTIONS] = {0.0};
    float *truth = malloc((size_t)(SIZE * SIZE) * sizeof(float[3]));
    assert_non_null(truth);
    for (uint32_t seed = 1; seed <= 2; seed++) {
        dpl_field *field = dpl_test_world(context, SIZE, SIZE, seed, 0);
        truth_solve(field, 384, 0, truth);
        for (int r = 0; r < RESOLUTIONS; r++) {
            float *rgb = light_of(field, resolutions[r]);
            errors[r] += error_of(field, rgb, truth, SIZE * SIZE) / 2;
            free(rgb);
        }
        dpl_field_destroy(field);
    }
    free(truth);
    assert_true(errors[3] < 0.95 * errors[0]); /* the truth, of few directions, is part of both: 0.91 */
    assert_true(errors[0] < errors[1] && errors[1] < errors[2]);
    assert_true(errors[1] < 0.08 && errors[2] < 0.16);
}

static void half_storage_is_close_to_floats(void **state) {
    (void)state;
    dpl_field *field = dpl_test_world(context, 77, 50, 4, 1);
    static float rgb[77 * 50 * 3];
    for (int r = 0; r < RESOLUTIONS; r++) {
        dpl_solver *solver = solver_at(resolutions[r], DPL_STORAGE_HALF);
        dpl_output output = {.data = rgb, .width = 77, .height = 50, .channels = 3};
        float *floats = light_of(field, resolutions[r]);
        assert_ok(dpl_solver_solve(solver, field, &output));
        assert_true(error_of(field, rgb, floats, 77 * 50) < 0.005);
        free(floats);
        dpl_solver_destroy(solver);
    }
    dpl_field_destroy(field);
}

/* ---- walls that reflect, and directions --------------------------------------------------------------- */

/* In a closed room in which all shines and reflects alike, so does every wall that the room sees; what it
 * does not see shows its emission alone. */
static void walls_show_what_they_reflect(void **state) {
    (void)state;
    enum { SIZE = 48, BOUNCES = 3 };
    const double emission = 0.5, albedo = 0.6;
    double expected = emission * (1 + albedo * (1 + albedo * (1 + albedo)));
    dpl_field *field = truth_field(SIZE, SIZE, 0);
    truth_box(field, 0, 0, SIZE, SIZE, truth_wall(emission, albedo));
    truth_box(field, 8, 5, 38, 44, truth_air());
    static const int32_t seen[][2] = {{7, 20}, {38, 20}, {20, 4}, {20, 44}};
    for (int r = 0; r < RESOLUTIONS; r++) {
        static float rgb[SIZE][SIZE][3];
        dpl_solver *solver = solver_with(resolutions[r], DPL_STORAGE_FLOAT, BOUNCES);
        dpl_output output = {.data = &rgb[0][0][0], .width = SIZE, .height = SIZE, .channels = 3};
        assert_ok(dpl_solver_solve(solver, field, &output));
        dpl_solver_destroy(solver);
        for (size_t i = 0; i < sizeof seen / sizeof seen[0]; i++)
            truth_assert_close((double)rgb[seen[i][1]][seen[i][0]][0], expected, 1e-4);
        assert_true(rgb[2][20][0] == 0.5f && rgb[20][2][0] == 0.5f && rgb[46][46][0] == 0.5f);
    }
    dpl_field_destroy(field);
}

/* A wall of two paints, lit by a lamp: what its pixels show is close to what they show at full resolution,
 * each by its own paint, though blocks mix them. */
static void every_pixel_of_a_wall_reflects_by_its_own_paint(void **state) {
    (void)state;
    enum { SIZE = 64 };
    static float rgb[RESOLUTIONS][SIZE][SIZE][3];
    dpl_field *field = truth_field(SIZE, SIZE, 0);
    truth_box(field, 12, 28, 20, 36, truth_wall(2.0, 0.0));
    truth_box(field, 44, 0, 53, SIZE, truth_wall(0.0, 0.8));
    for (int y = 1; y < SIZE; y += 2)
        truth_box(field, 44, y, 53, y + 1, truth_wall(0.0, 0.2));
    for (int r = 0; r < RESOLUTIONS; r++) {
        dpl_solver *solver = solver_with(resolutions[r], DPL_STORAGE_FLOAT, 1);
        dpl_output output = {.data = &rgb[r][0][0][0], .width = SIZE, .height = SIZE, .channels = 3};
        assert_ok(dpl_solver_solve(solver, field, &output));
        dpl_solver_destroy(solver);
        for (int y = 16; y < 48; y++) {
            assert_true(rgb[r][y][44][0] > 0.0f);
            truth_assert_close((double)rgb[r][y][44][0], (double)rgb[0][y][44][0], 0.25);
        }
        truth_assert_close((double)rgb[r][32][44][0] / (double)rgb[r][33][44][0], 4.0, 0.1);
        assert_true(rgb[r][32][48][0] == 0.0f);
    }
    dpl_field_destroy(field);
}

typedef struct directed {
    float mean[3];
    float cosine[3];
    float sine[3];
} directed;

static directed direction_at(dpl_field *field, dpl_resolution resolution, int32_t x, int32_t y) {
    enum { SIZE = 64 };
    static float planes[3][SIZE][SIZE][3];
    dpl_solver *solver = solver_at(resolution, DPL_STORAGE_FLOAT);
    dpl_output outputs[3];
    for (int i = 0; i < 3; i++)
        outputs[i] = (dpl_output){.data = &planes[i][0][0][0], .width = SIZE, .height = SIZE, .channels = 3};
    assert_ok(dpl_solver_solve_directional(solver, field, &outputs[0], &outputs[1], &outputs[2]));
    dpl_solver_destroy(solver);
    directed d;
    memcpy(d.mean, planes[0][y][x], sizeof d.mean);
    memcpy(d.cosine, planes[1][y][x], sizeof d.cosine);
    memcpy(d.sine, planes[2][y][x], sizeof d.sine);
    return d;
}

static void directions_point_to_the_lamp_at_every_resolution(void **state) {
    (void)state;
    static const int32_t places[][2] = {{50, 20}, {8, 9}, {20, 50}, {33, 60}};
    dpl_field *field = truth_field(64, 64, 0);
    truth_box(field, 16, 16, 24, 24, truth_wall(3.0, 0.0));
    for (int r = 0; r < RESOLUTIONS; r++) {
        for (size_t i = 0; i < sizeof places / sizeof places[0]; i++) {
            double across = 20.0 - places[i][0] - 0.5, down = 20.0 - places[i][1] - 0.5;
            directed d = direction_at(field, resolutions[r], places[i][0], places[i][1]);
            double strength = hypot((double)d.cosine[0], (double)d.sine[0]), length = hypot(across, down);
            /* a lamp is nearly a point: the vector is nearly as long as the mean */
            truth_assert_close(strength, (double)d.mean[0], 0.12);
            truth_assert_near((double)d.cosine[0] / strength, across / length, 0.1);
            truth_assert_near((double)d.sine[0] / strength, down / length, 0.1);
        }
        directed inside = direction_at(field, resolutions[r], 20, 20);
        assert_true(inside.mean[0] == 3.0f && inside.cosine[0] == 0.0f && inside.sine[0] == 0.0f);
    }
    dpl_field_destroy(field);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_resolution_that_does_not_exist_is_refused),
        cmocka_unit_test(an_empty_world_of_any_size_shows_its_sky),
        cmocka_unit_test(the_longest_world_is_solved),
        cmocka_unit_test(an_opaque_world_shows_its_emission),
        cmocka_unit_test(nothing_leaks_into_a_room_of_walls_one_pixel_wide),
        cmocka_unit_test(nothing_leaks_through_slanted_walls_one_pixel_wide),
        cmocka_unit_test(a_lamp_of_two_pixels_shines_as_bright_wherever_it_lies),
        cmocka_unit_test(media_keep_their_brightness),
        cmocka_unit_test(fog_lets_through_as_much_as_at_full_resolution),
        cmocka_unit_test(a_margin_is_the_rim_of_a_larger_picture),
        cmocka_unit_test(finer_grids_are_closer_to_the_truth),
        cmocka_unit_test(half_storage_is_close_to_floats),
        cmocka_unit_test(walls_show_what_they_reflect),
        cmocka_unit_test(every_pixel_of_a_wall_reflects_by_its_own_paint),
        cmocka_unit_test(directions_point_to_the_lamp_at_every_resolution),
    };
    return cmocka_run_group_tests(tests, open_context, close_context);
}
