/* Radiance cascades against the reference and closed forms, at every merge, at odd sizes, in media. */
#include "testing.h"
#include "world.h"

#include "shared_context.h" /* behind the others: they have parameters called context */

#include <math.h>
#include <stdlib.h>

static float *solve(dpl_field *field, const dpl_solver_desc *desc) {
    int32_t width = dpl_field_width(field), height = dpl_field_height(field);
    float *rgb = malloc((size_t)width * (size_t)height * 3 * sizeof(float));
    dpl_solver *solver;
    assert_non_null(rgb);
    assert_ok(dpl_solver_create(context, desc, &solver));
    dpl_output output = {.data = rgb, .width = width, .height = height, .channels = 3};
    assert_ok(dpl_solver_solve(solver, field, &output));
    dpl_solver_stats stats;
    dpl_solver_read_stats(solver, &stats);
    assert_true(stats.rays_traced > 0 && stats.rays_traced == stats.rays_full);
    dpl_solver_destroy(solver);
    return rgb;
}

/* rms error over mean of the truth, free pixels. */
static double relative_error(dpl_field *field, const float *rgb, const float *truth) {
    int32_t count = dpl_field_width(field) * dpl_field_height(field);
    uint8_t *opaque = malloc((size_t)count);
    double squares = 0.0, sum = 0.0;
    int64_t values = 0;
    assert_non_null(opaque);
    assert_ok(dpl_field_read_opaque(field, opaque, 0));
    for (int32_t i = 0; i < count * 3; i++) {
        if (opaque[i / 3])
            continue;
        double error = (double)rgb[i] - (double)truth[i];
        squares += error * error;
        sum += (double)truth[i];
        values++;
    }
    free(opaque);
    return sqrt(squares / (double)values) / (sum / (double)values);
}

static double error_of_merge(dpl_field *field, const float *truth, dpl_merge merge, int32_t spacing) {
    dpl_solver_desc desc = dpl_solver_desc_default();
    desc.kind = DPL_SOLVER_CASCADES;
    desc.cascades.merge = merge;
    desc.cascades.spacing = spacing;
    desc.cascades.directions = 4 * spacing * spacing;
    float *rgb = solve(field, &desc);
    double error = relative_error(field, rgb, truth);
    free(rgb);
    return error;
}

/* A small picture is a hard one: everything is near its shadow. The errors of full-sized scenes are measured
 * by the benchmark; these limits lie a fifth above what this scene gives. */
static void assert_close_to_reference(int fog) {
    dpl_field *field = dpl_test_world(context, 128, 96, 3, fog);
    dpl_solver_desc desc = dpl_solver_desc_default();
    desc.kind = DPL_SOLVER_REFERENCE;
    desc.reference.directions = 1024;
    float *truth = solve(field, &desc);
    double plain = error_of_merge(field, truth, DPL_MERGE_BILINEAR, 1);
    double fix = error_of_merge(field, truth, DPL_MERGE_BILINEAR_FIX, 1);
    double nearest = error_of_merge(field, truth, DPL_MERGE_NEAREST_FIX, 1);
    double coarse = error_of_merge(field, truth, DPL_MERGE_BILINEAR_FIX, 2);
    free(truth);
    dpl_field_destroy(field);
    assert_true(plain < (fog ? 0.080 : 0.134));
    assert_true(fix < (fog ? 0.060 : 0.099));
    assert_true(nearest < (fog ? 0.116 : 0.183));
    assert_true(coarse < (fog ? 0.082 : 0.145));
    assert_true(fix < plain); /* what the fix is for */
}

static void cascades_come_close_to_the_reference(void **state) {
    (void)state;
    assert_close_to_reference(0);
}

static void cascades_come_close_to_the_reference_in_fog(void **state) {
    (void)state;
    assert_close_to_reference(1);
}

static void an_empty_field_shows_the_sky(void **state) {
    (void)state;
    static const int32_t sizes[][2] = {{1, 1}, {1, 9}, {7, 1}, {2, 2}, {33, 65}, {130, 5}, {129, 129}};
    for (size_t i = 0; i < sizeof sizes / sizeof sizes[0]; i++)
        for (int merge = 0; merge < 3; merge++) {
            dpl_field_desc field_desc = dpl_field_desc_default();
            dpl_field *field;
            field_desc.width = sizes[i][0];
            field_desc.height = sizes[i][1];
            field_desc.sky[0] = 0.25f;
            field_desc.sky[1] = 3.0f;
            assert_ok(dpl_field_create(context, &field_desc, &field));
            dpl_solver_desc desc = dpl_solver_desc_default();
            desc.kind = DPL_SOLVER_CASCADES;
            desc.cascades.merge = (dpl_merge)merge;
            float *rgb = solve(field, &desc);
            for (int32_t p = 0; p < sizes[i][0] * sizes[i][1]; p++) {
                assert_float_equal(rgb[3 * p], 0.25f, 1e-6f);
                assert_float_equal(rgb[3 * p + 1], 3.0f, 1e-5f);
                assert_true(rgb[3 * p + 2] == 0.0f);
            }
            free(rgb);
            dpl_field_destroy(field);
        }
}

/* A border of radiance 0.75, `border` pixels thick, around nothing: the lowest value found anywhere. */
static double darkest_in_furnace(int32_t width, int32_t height, double border, dpl_merge merge,
                                 int32_t spacing) {
    dpl_field_desc field_desc = dpl_field_desc_default();
    dpl_field *field;
    field_desc.width = width;
    field_desc.height = height;
    assert_ok(dpl_field_create(context, &field_desc, &field));
    dpl_shape shapes[2] = {dpl_shape_default(DPL_SHAPE_BOX), dpl_shape_default(DPL_SHAPE_BOX)};
    for (int c = 0; c < 3; c++)
        shapes[0].material.emission[c] = 0.75f;
    shapes[0].box = (dpl_box){{width / 2.0, height / 2.0}, {width / 2.0, height / 2.0}, 0};
    shapes[1].box = (dpl_box){{width / 2.0, height / 2.0}, {width / 2.0 - border, height / 2.0 - border}, 0};
    memset(shapes[1].material.extinction, 0, sizeof shapes[1].material.extinction);
    assert_ok(dpl_field_draw_shapes(field, shapes, 2));
    dpl_solver_desc desc = dpl_solver_desc_default();
    desc.kind = DPL_SOLVER_CASCADES;
    desc.cascades.merge = merge;
    desc.cascades.spacing = spacing;
    float *rgb = solve(field, &desc);
    double darkest = 1.0;
    for (int32_t p = 0; p < width * height; p++) {
        assert_true(rgb[3 * p] < 0.7501f);
        darkest = fmin(darkest, (double)rgb[3 * p]);
    }
    free(rgb);
    dpl_field_destroy(field);
    return darkest;
}

static void in_a_furnace_everything_equals_the_border(void **state) {
    (void)state;
    static const int32_t sizes[][2] = {{9, 9}, {40, 19}, {97, 61}, {128, 128}};
    for (size_t i = 0; i < sizeof sizes / sizeof sizes[0]; i++)
        for (int merge = DPL_MERGE_BILINEAR_FIX; merge <= DPL_MERGE_NEAREST_FIX; merge++)
            for (int32_t spacing = 1; spacing <= 2; spacing++) {
                double thick = darkest_in_furnace(sizes[i][0], sizes[i][1], 4, (dpl_merge)merge, spacing);
                double thin = darkest_in_furnace(sizes[i][0], sizes[i][1], 1, (dpl_merge)merge, spacing);
                /* A slot is the mean of rays that begin a little beside the one that ends there: a border
                 * thinner than that gap loses a few hundredths. See docs/algorithms/radiance-cascades.md. */
                assert_true(thick > 0.7499);
                assert_true(thin > (spacing == 1 ? 0.7499 : 0.72));
            }
}

static void a_disc_light_in_the_open_gives_about_the_arcsine(void **state) {
    (void)state;
    dpl_field_desc field_desc = dpl_field_desc_default();
    dpl_field *field;
    field_desc.width = field_desc.height = 257;
    assert_ok(dpl_field_create(context, &field_desc, &field));
    dpl_shape light = dpl_shape_default(DPL_SHAPE_DISC);
    light.disc = (dpl_disc){{128.5, 128.5}, 40.0};
    light.material.emission[0] = 1.0f;
    assert_ok(dpl_field_draw_shapes(field, &light, 1));
    dpl_solver_desc desc = dpl_solver_desc_default();
    desc.kind = DPL_SOLVER_CASCADES;
    float *rgb = solve(field, &desc);
    for (int32_t x = 172; x < 257; x += 6) {
        double expected = asin(40.0 / (x - 128)) / 3.14159265358979;
        assert_true(fabs((double)rgb[3 * (128 * 257 + x)] - expected) < 0.05 * expected + 0.01);
    }
    assert_true(rgb[3 * (128 * 257 + 128)] == 1.0f); /* an opaque pixel shows its emission */
    free(rgb);
    dpl_field_destroy(field);
}

static void a_wall_without_gaps_lets_no_light_through(void **state) {
    (void)state;
    /* One pixel thick, straight and as a staircase of diagonal contacts: the far side is black. */
    for (int diagonal = 0; diagonal < 2; diagonal++)
        for (int merge = DPL_MERGE_BILINEAR_FIX; merge < 3; merge++) {
            dpl_field_desc field_desc = dpl_field_desc_default();
            dpl_field *field;
            field_desc.width = field_desc.height = 64;
            assert_ok(dpl_field_create(context, &field_desc, &field));
            dpl_shape shapes[2] = {dpl_shape_default(DPL_SHAPE_SEGMENT), dpl_shape_default(DPL_SHAPE_DISC)};
            double rise = diagonal ? 32.0 : 0.0;
            shapes[0].segment = (dpl_segment){{0.5, 31.5 - rise}, {63.5, 31.5 + rise}, diagonal ? 1.5 : 0.5};
            shapes[1].disc = (dpl_disc){{16.0, 50.0}, 6.0};
            shapes[1].material.emission[0] = 5.0f;
            assert_ok(dpl_field_draw_shapes(field, shapes, 2));
            dpl_solver_desc desc = dpl_solver_desc_default();
            desc.kind = DPL_SOLVER_CASCADES;
            desc.cascades.merge = (dpl_merge)merge;
            float *rgb = solve(field, &desc);
            /* Interpolating between probes lets a little through near the wall; further away there is none.
             */
            double leak = 0.0;
            for (int32_t y = 0; y < 16; y++)
                for (int32_t x = 48; x < 64; x++)
                    leak = fmax(leak, (double)rgb[3 * (y * 64 + x)]);
            if (leak > 1e-3)
                fail_msg("merge %d, diagonal %d: %g leaks", merge, diagonal, leak);
            free(rgb);
            dpl_field_destroy(field);
        }
}

static void the_longest_strips_are_lit(void **state) {
    (void)state;
    for (int turn = 0; turn < 2; turn++) {
        dpl_field_desc field_desc = dpl_field_desc_default();
        dpl_field *field;
        field_desc.width = turn ? 1 : DPL_MAX_SIZE;
        field_desc.height = turn ? DPL_MAX_SIZE : 1;
        field_desc.sky[0] = 0.5f;
        assert_ok(dpl_field_create(context, &field_desc, &field));
        dpl_shape wall = dpl_shape_default(DPL_SHAPE_DISC);
        wall.disc = (dpl_disc){{turn ? 0.5 : 8000.5, turn ? 8000.5 : 0.5}, 0.0};
        assert_ok(dpl_field_draw_shapes(field, &wall, 1));
        dpl_solver_desc desc = dpl_solver_desc_default();
        desc.kind = DPL_SOLVER_CASCADES;
        desc.cascades.merge = DPL_MERGE_BILINEAR;
        desc.cascades.interval = 16.0; /* fewer levels: their rays double from one to the next in a strip */
        float *rgb = solve(field, &desc);
        for (int32_t p = 0; p < DPL_MAX_SIZE; p++)
            assert_true(p == 8000 ? rgb[3 * p] == 0.0f : rgb[3 * p] > 0.2f && rgb[3 * p] < 0.5001f);
        free(rgb);
        dpl_field_destroy(field);
    }
}

static void output_strides_channels_and_flips_are_honoured(void **state) {
    (void)state;
    enum { W = 19, H = 11 };
    static float plain[H][W][3], padded[H][W * 4 + 5];
    dpl_field *field = dpl_test_world(context, W, H, 5, 1);
    dpl_solver *solver = dpl_test_solver(context, DPL_SOLVER_CASCADES, DPL_MERGE_BILINEAR, 0);
    for (int i = 0; i < H * (W * 4 + 5); i++)
        (&padded[0][0])[i] = -7.0f;
    dpl_output output = {.data = &plain[0][0][0], .width = W, .height = H, .channels = 3};
    assert_ok(dpl_solver_solve(solver, field, &output));
    output = (dpl_output){.data = padded[H - 1],
                          .width = W,
                          .height = H,
                          .channels = 4,
                          .row_stride = -(ptrdiff_t)sizeof padded[0]};
    assert_ok(dpl_solver_solve(solver, field, &output));
    for (int y = 0; y < H; y++)
        for (int x = 0; x < W * 4 + 5; x++) {
            float expected = x >= W * 4 ? -7.0f : x % 4 == 3 ? 1.0f : plain[H - 1 - y][x / 4][x % 4];
            assert_true(padded[y][x] == expected);
        }
    output.width = W - 1;
    assert_int_equal(dpl_solver_solve(solver, field, &output), DPL_ERROR_SIZE);
    output = (dpl_output){.data = NULL, .width = W, .height = H, .channels = 3};
    assert_int_equal(dpl_solver_solve(solver, field, &output), DPL_ERROR_ARGUMENT);
    output = (dpl_output){.data = &plain[0][0][0], .width = W, .height = H, .channels = 2};
    assert_int_equal(dpl_solver_solve(solver, field, &output), DPL_ERROR_ARGUMENT);
    output = (dpl_output){.data = &plain[0][0][0], .width = W, .height = H, .channels = 3, .row_stride = 16};
    assert_int_equal(dpl_solver_solve(solver, field, &output), DPL_ERROR_ARGUMENT);
    dpl_solver_destroy(solver);
    dpl_field_destroy(field);
}

static void bad_solvers_are_refused(void **state) {
    (void)state;
    dpl_solver_desc desc = dpl_solver_desc_default();
    desc.kind = DPL_SOLVER_CASCADES;
    dpl_solver *solver;
    desc.cascades.spacing = 1000;
    assert_int_equal(dpl_solver_create(context, &desc, &solver), DPL_ERROR_ARGUMENT);
    assert_null(solver);
    desc = dpl_solver_desc_default();
    desc.kind = (dpl_solver_kind)9;
    assert_int_equal(dpl_solver_create(context, &desc, &solver), DPL_ERROR_ARGUMENT);
    desc = dpl_solver_desc_default();
    desc.kind = DPL_SOLVER_REFERENCE;
    desc.reference.directions = -4;
    assert_int_equal(dpl_solver_create(context, &desc, &solver), DPL_ERROR_ARGUMENT);
    desc.cookie = 1;
    assert_int_equal(dpl_solver_create(context, &desc, &solver), DPL_ERROR_DESC);
    dpl_context *other;
    assert_ok(dpl_context_create(NULL, &other));
    dpl_field *field = dpl_test_world(other, 8, 8, 1, 0);
    solver = dpl_test_solver(context, DPL_SOLVER_CASCADES, DPL_MERGE_BILINEAR, 0);
    float rgb[8 * 8 * 3];
    dpl_output output = {.data = rgb, .width = 8, .height = 8, .channels = 3};
    assert_int_equal(dpl_solver_solve(solver, field, &output),
                     DPL_ERROR_ARGUMENT); /* another context's field */
    dpl_solver_destroy(solver);
    dpl_field_destroy(field);
    dpl_context_destroy(other);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(cascades_come_close_to_the_reference),
        cmocka_unit_test(cascades_come_close_to_the_reference_in_fog),
        cmocka_unit_test(an_empty_field_shows_the_sky),
        cmocka_unit_test(in_a_furnace_everything_equals_the_border),
        cmocka_unit_test(a_disc_light_in_the_open_gives_about_the_arcsine),
        cmocka_unit_test(a_wall_without_gaps_lets_no_light_through),
        cmocka_unit_test(the_longest_strips_are_lit),
        cmocka_unit_test(output_strides_channels_and_flips_are_honoured),
        cmocka_unit_test(bad_solvers_are_refused),
    };
    return cmocka_run_group_tests(tests, open_context, close_context);
}
