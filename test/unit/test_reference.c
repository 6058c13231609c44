/* The reference against closed forms: everything else is judged by it, so it is judged first. Pictures are
 * chosen large enough that the pixels' own staircase stays below the tolerance. */
#include "testing.h"

#include <dapple/dapple.h>
#include <math.h>
#include <stdlib.h>

static const double PI = 3.14159265358979323846;

/* Relative error allowed against a closed form. */
#define TOLERANCE 0.002

typedef struct fixture {
    dpl_context *context;
    dpl_field *field;
    dpl_solver *solver;
} fixture;

static fixture open_field(int32_t width, int32_t height, int32_t directions) {
    fixture f;
    assert_ok(dpl_context_create(NULL, &f.context));
    dpl_field_desc field = dpl_field_desc_default();
    field.width = width;
    field.height = height;
    assert_ok(dpl_field_create(f.context, &field, &f.field));
    dpl_solver_desc solver = dpl_solver_desc_default();
    solver.kind = DPL_SOLVER_REFERENCE;
    solver.reference.directions = directions;
    assert_ok(dpl_solver_create(f.context, &solver, &f.solver));
    return f;
}

static void close_field(fixture *f) {
    dpl_solver_destroy(f->solver);
    dpl_field_destroy(f->field);
    dpl_context_destroy(f->context);
}

static void draw_disc(fixture *f, double x, double y, double radius, const float emission[3]) {
    dpl_shape shape = dpl_shape_default(DPL_SHAPE_DISC);
    shape.disc = (dpl_disc){{x, y}, radius};
    memcpy(shape.material.emission, emission, sizeof shape.material.emission);
    assert_ok(dpl_field_draw_shapes(f->field, &shape, 1));
}

static void draw_box(fixture *f, double x0, double y0, double x1, double y1, float emission,
                     float extinction) {
    dpl_shape shape = dpl_shape_default(DPL_SHAPE_BOX);
    shape.box = (dpl_box){{0.5 * (x0 + x1), 0.5 * (y0 + y1)}, {0.5 * (x1 - x0), 0.5 * (y1 - y0)}, 0.0};
    for (int c = 0; c < 3; c++) {
        shape.material.emission[c] = emission;
        shape.material.extinction[c] = extinction;
    }
    assert_ok(dpl_field_draw_shapes(f->field, &shape, 1));
}

/* Mean radiance at one pixel. */
static void light_at(fixture *f, int32_t x, int32_t y, float rgb[3]) {
    const int32_t pixel[1][2] = {{x, y}};
    float result[1][3];
    assert_ok(dpl_reference_solve_pixels(f->solver, f->field, pixel, 1, result));
    memcpy(rgb, result[0], sizeof result[0]);
}

static void assert_close(double value, double expected) {
    if (fabs(value - expected) > TOLERANCE * fabs(expected))
        fail_msg("%.6f is not within 0.2 %% of %.6f", value, expected);
}

static void a_disc_light_in_the_open_gives_the_arcsine(void **state) {
    (void)state;
    static const float emission[3] = {1.0f, 2.0f, 0.5f};
    const int32_t centre = 1300;
    const double radius = 1000.0;
    fixture f = open_field(2 * centre + 1, 2 * centre + 1, 4096);
    draw_disc(&f, centre + 0.5, centre + 0.5, radius, emission);
    static const int32_t pixels[][2] = {{2590, 1300}, {1300, 20}, {2400, 2400}, {190, 2000}, {50, 2500}};
    for (size_t i = 0; i < sizeof pixels / sizeof pixels[0]; i++) {
        float rgb[3];
        double distance = hypot(pixels[i][0] - centre, pixels[i][1] - centre);
        light_at(&f, pixels[i][0], pixels[i][1], rgb);
        for (int c = 0; c < 3; c++)
            assert_close((double)rgb[c], (double)emission[c] * asin(radius / distance) / PI);
    }
    close_field(&f);
}

static void a_half_plane_gives_half_of_its_radiance(void **state) {
    (void)state;
    /* Seen from the edge row's middle, the emitting half fills the angle between the two corners of its edge.
     */
    fixture f = open_field(2001, 1001, 4096);
    draw_box(&f, 0.0, 500.0, 2001.0, 1001.0, 3.0f, INFINITY);
    for (int32_t y = 499; y > 0; y -= 83) {
        float rgb[3];
        double below = 500.0 - (y + 0.5);
        light_at(&f, 1000, y, rgb);
        assert_close((double)rgb[0], 3.0 * 2.0 * atan2(1000.5, below) / (2.0 * PI));
    }
    close_field(&f);
}

/* What is left of a disc light behind a disc wall, as a share of all directions. */
static double light_left(const double light[3], const double wall[3], double x, double y) {
    double half_light = asin(light[2] / hypot(light[0] - x, light[1] - y));
    double half_wall = asin(wall[2] / hypot(wall[0] - x, wall[1] - y));
    double apart = atan2(light[1] - y, light[0] - x) - atan2(wall[1] - y, wall[0] - x);
    apart = fabs(remainder(apart, 2.0 * PI));
    double from = fmax(-half_light, apart - half_wall), to = fmin(half_light, apart + half_wall);
    return (2.0 * half_light - fmax(0.0, to - from)) / (2.0 * PI);
}

static void a_disc_eclipses_another(void **state) {
    (void)state;
    static const float bright[3] = {1.0f, 1.0f, 1.0f}, black[3] = {0.0f, 0.0f, 0.0f};
    static const double light[3] = {1000.5, 1000.5, 900.0}, wall[3] = {2250.5, 1200.5, 250.0};
    fixture f = open_field(3001, 2001, 4096);
    draw_disc(&f, light[0], light[1], light[2], bright);
    draw_disc(&f, wall[0], wall[1], wall[2], black);
    /* Down a line behind the wall: uncovered, partly covered, annular, and back. 4096 directions see a narrow
     * crescent by a few hundred rays only, so it is the mean over the line that is held to the tolerance. */
    double sum = 0.0, expected = 0.0;
    int annular = 0, partial = 0;
    for (int32_t y = 3; y < 2001; y += 13) {
        float rgb[3];
        light_at(&f, 2990, y, rgb);
        double left = light_left(light, wall, 2990.5, y + 0.5);
        double open = asin(light[2] / hypot(light[0] - 2990.5, light[1] - y - 0.5)) / PI;
        double hides = asin(wall[2] / hypot(wall[0] - 2990.5, wall[1] - y - 0.5)) / PI;
        annular += left < open && left < open - hides + 1e-9;
        partial += left < open && left > open - hides + 1e-9;
        assert_float_equal((double)rgb[0], left, 2.0 / 4096);
        sum += (double)rgb[0];
        expected += left;
    }
    assert_true(annular > 5 && partial > 20);
    assert_close(sum, expected);
    /* Close behind a wall that looks larger than the light there is none at all. */
    float rgb[3];
    light_at(&f, 2510, 1250, rgb);
    assert_true(rgb[0] == 0.0f);
    close_field(&f);
}

static void in_a_furnace_everything_equals_the_border(void **state) {
    (void)state;
    fixture f = open_field(97, 61, 4096);
    draw_box(&f, 0.0, 0.0, 97.0, 61.0, 0.75f, INFINITY);
    draw_box(&f, 1.0, 1.0, 96.0, 60.0, 0.0f, 0.0f);    /* hollow again */
    draw_box(&f, 30.0, 20.0, 50.0, 30.0, 0.75f, 0.3f); /* a medium of the same radiance changes nothing */
    float *rgb = malloc(sizeof(float) * 97 * 61 * 3);
    assert_non_null(rgb);
    dpl_output output = {.data = rgb, .width = 97, .height = 61, .channels = 3};
    assert_ok(dpl_solver_solve(f.solver, f.field, &output));
    for (int i = 0; i < 97 * 61 * 3; i++)
        assert_float_equal(rgb[i], 0.75f, 1e-6f);
    free(rgb);
    close_field(&f);
}

static void a_uniform_medium_follows_beer_and_lambert(void **state) {
    (void)state;
    /* Fog fills the picture, the sky shines behind. A ray of length d adds e (1 - exp(-s d)) + sky exp(-s d).
     */
    const double s = 0.004, e = 0.5, sky = 2.0;
    const float sky_rgb[3] = {2.0f, 2.0f, 2.0f};
    const int32_t size = 401, directions = 4096;
    fixture f = open_field(size, size, directions);
    draw_box(&f, 0.0, 0.0, size, size, (float)e, (float)s);
    assert_ok(dpl_field_set_sky(f.field, sky_rgb));
    float rgb[3];
    light_at(&f, 200, 200, rgb);
    /* The integral over a square's directions, by a fine midpoint rule. */
    double sum = 0.0;
    const int steps = 200000;
    for (int i = 0; i < steps; i++) {
        double angle = 0.25 * PI * (i + 0.5) / steps, passed = exp(-s * 200.5 / cos(angle));
        sum += e * (1.0 - passed) + sky * passed;
    }
    assert_close((double)rgb[0], sum / steps);
    close_field(&f);
}

static void extinction_is_told_apart_by_colour(void **state) {
    (void)state;
    /* A pane of tinted glass 10 px thick around the pixel: each channel has its own transmittance. */
    fixture f = open_field(201, 201, 4096);
    const float sky[3] = {1.0f, 1.0f, 1.0f};
    assert_ok(dpl_field_set_sky(f.field, sky));
    dpl_shape glass = dpl_shape_default(DPL_SHAPE_DISC);
    glass.disc = (dpl_disc){{100.5, 100.5}, 80.0};
    glass.material.extinction[0] = 0.01f;
    glass.material.extinction[1] = 0.0f;
    glass.material.extinction[2] = INFINITY;
    assert_ok(dpl_field_draw_shapes(f.field, &glass, 1));
    float rgb[3];
    light_at(&f, 100, 100, rgb);
    assert_close((double)rgb[0], exp(-0.01 * 80.0));
    assert_float_equal(rgb[1], 1.0f, 1e-6f);
    assert_true(rgb[2] == 0.0f);
    close_field(&f);
}

/* Draws an irregular scene, every pixel by hand, through `map` from scene to picture pixels. */
static void draw_pixels(fixture *f, int32_t size, void (*map)(int32_t, int32_t *, int32_t *)) {
    float *emission = calloc((size_t)size * (size_t)size, 3 * sizeof(float));
    float *extinction = calloc((size_t)size * (size_t)size, sizeof(float));
    assert_non_null(emission);
    assert_non_null(extinction);
    uint32_t seed = 7;
    for (int32_t i = 0; i < size * size; i++) {
        seed = seed * 1664525u + 1013904223u;
        int32_t x = i % size, y = i / size;
        map(size, &x, &y);
        size_t at = (size_t)y * (size_t)size + (size_t)x;
        if (seed >> 24 < 20)
            extinction[at] = INFINITY;
        else if (seed >> 24 < 40)
            extinction[at] = 0.1f;
        if (seed >> 24 < 30)
            emission[3 * at] = (float)(seed >> 16 & 255) / 64.0f;
    }
    dpl_layer layer = dpl_layer_default();
    layer.extinction_is_opacity = 0;
    layer.emission = (dpl_pixels){emission, DPL_FORMAT_F32, size, size, 3, 0};
    layer.extinction = (dpl_pixels){extinction, DPL_FORMAT_F32, size, size, 1, 0};
    assert_ok(dpl_field_draw_layer(f->field, &layer));
    free(emission);
    free(extinction);
}

static void keep(int32_t size, int32_t *x, int32_t *y) {
    (void)size;
    (void)x;
    (void)y;
}

static void mirror(int32_t size, int32_t *x, int32_t *y) {
    (void)y;
    *x = size - 1 - *x;
}

static void quarter_turn(int32_t size, int32_t *x, int32_t *y) {
    int32_t old_x = *x;
    *x = size - 1 - *y;
    *y = old_x;
}

static void assert_symmetric(void (*map)(int32_t, int32_t *, int32_t *)) {
    enum { SIZE = 49 };
    static float plain[SIZE * SIZE * 3], mapped[SIZE * SIZE * 3];
    void (*maps[2])(int32_t, int32_t *, int32_t *) = {keep, map};
    for (int i = 0; i < 2; i++) {
        fixture f = open_field(SIZE, SIZE, 1024);
        draw_pixels(&f, SIZE, maps[i]);
        dpl_output output = {.data = i == 0 ? plain : mapped, .width = SIZE, .height = SIZE, .channels = 3};
        assert_ok(dpl_solver_solve(f.solver, f.field, &output));
        close_field(&f);
    }
    double sum = 0.0;
    for (int32_t i = 0; i < SIZE * SIZE; i++) {
        int32_t x = i % SIZE, y = i / SIZE;
        map(SIZE, &x, &y);
        assert_float_equal(plain[3 * i], mapped[3 * (y * SIZE + x)], 1e-5f);
        sum += (double)plain[3 * i];
    }
    assert_true(sum > 1.0); /* there was light to compare */
}

static void a_mirrored_scene_gives_the_mirrored_light(void **state) {
    (void)state;
    assert_symmetric(mirror);
}

static void a_turned_scene_gives_the_turned_light(void **state) {
    (void)state;
    assert_symmetric(quarter_turn);
}

static void rays_are_counted_from_free_pixels_only(void **state) {
    (void)state;
    fixture f = open_field(20, 10, 64);
    draw_box(&f, 0.0, 0.0, 5.0, 10.0, 1.0f, INFINITY);
    float rgb[20 * 10 * 4];
    dpl_output output = {.data = rgb, .width = 20, .height = 10, .channels = 4};
    assert_ok(dpl_solver_solve(f.solver, f.field, &output));
    dpl_solver_stats stats;
    dpl_solver_read_stats(f.solver, &stats);
    assert_int_equal(stats.level_count, 1);
    assert_int_equal(stats.levels[0].probes, 150);
    assert_int_equal(stats.rays_traced, 150 * 64);
    assert_int_equal(stats.rays_full, 150 * 64);
    assert_true(rgb[0] == 1.0f && rgb[3] == 1.0f); /* an opaque pixel shows its emission; alpha is 1 */
    close_field(&f);
}

static int cancel_at_once(double done, void *user) {
    (void)done;
    ++*(int *)user;
    return 0;
}

static void a_cancelled_solve_leaves_the_output_alone(void **state) {
    (void)state;
    fixture f = open_field(32, 32, 16);
    int calls = 0;
    dpl_solver_desc desc = dpl_solver_desc_default();
    desc.kind = DPL_SOLVER_REFERENCE;
    desc.progress = cancel_at_once;
    desc.progress_user = &calls;
    dpl_solver *solver;
    assert_ok(dpl_solver_create(f.context, &desc, &solver));
    float rgb[32 * 32 * 3];
    for (int i = 0; i < 32 * 32 * 3; i++)
        rgb[i] = -1.0f;
    dpl_output output = {.data = rgb, .width = 32, .height = 32, .channels = 3};
    assert_int_equal(dpl_solver_solve(solver, f.field, &output), DPL_ERROR_CANCELLED);
    assert_int_equal(calls, 1);
    for (int i = 0; i < 32 * 32 * 3; i++)
        assert_true(rgb[i] == -1.0f);
    dpl_solver_destroy(solver);
    close_field(&f);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_disc_light_in_the_open_gives_the_arcsine),
        cmocka_unit_test(a_half_plane_gives_half_of_its_radiance),
        cmocka_unit_test(a_disc_eclipses_another),
        cmocka_unit_test(in_a_furnace_everything_equals_the_border),
        cmocka_unit_test(a_uniform_medium_follows_beer_and_lambert),
        cmocka_unit_test(extinction_is_told_apart_by_colour),
        cmocka_unit_test(a_mirrored_scene_gives_the_mirrored_light),
        cmocka_unit_test(a_turned_scene_gives_the_turned_light),
        cmocka_unit_test(rays_are_counted_from_free_pixels_only),
        cmocka_unit_test(a_cancelled_solve_leaves_the_output_alone),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
