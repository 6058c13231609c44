/* Pictures of halves at the library's doors: layers that are drawn from them, results that are written as
 * them, and what is refused. */
#include "field/field.h"
#include "kernel/half.h"
#include "testing.h"
#include "world.h"

#include "shared_context.h" /* behind the others: they have parameters called context */

#include <math.h>

enum { W = 300, H = 5 }; /* wider than two runs */

static uint16_t halves[3][H][W + 1][3];
static float floats[3][H][W + 1][3];

static void set(int part, int y, int x, int c, float value) {
    halves[part][y][x][c] = dpl_half_from_float(value);
    floats[part][y][x][c] = dpl_float_from_half(halves[part][y][x][c]);
}

/* Emission, opacity with a third empty and a third opaque, albedo. */
static void fill_pictures(void) {
    for (int i = 0; i < H * W * 3; i++) {
        int y = i / (W * 3), x = i / 3 % W, c = i % 3;
        set(0, y, x, c, 0.37f * (float)(i % 1000));
        set(1, y, x, c, x % 3 == 0 ? 0.0f : x % 3 == 1 ? 1.0f : (float)(i % 97) / 97.0f);
        set(2, y, x, c, (float)(i % 101) / 101.0f);
    }
}

static dpl_field *field_of_size(int32_t width, int32_t height) {
    dpl_field_desc desc = dpl_field_desc_default();
    desc.width = width;
    desc.height = height;
    dpl_field *field;
    assert_ok(dpl_field_create(context, &desc, &field));
    return field;
}

static dpl_field *drawn_from(const void *const data[3], dpl_format format, size_t channel_bytes) {
    dpl_field *field = field_of_size(W, H);
    dpl_layer layer = dpl_layer_default();
    dpl_pixels pixels = {.format = format, .width = W, .height = H, .channels = 3};
    pixels.row_stride = (ptrdiff_t)((W + 1) * 3 * channel_bytes);
    layer.emission = layer.extinction = layer.albedo = pixels;
    layer.emission.data = data[0];
    layer.extinction.data = data[1];
    layer.albedo.data = data[2];
    layer.intensity = 1.5f;
    assert_ok(dpl_field_draw_layer(field, &layer));
    return field;
}

static void a_layer_of_halves_is_drawn_like_one_of_floats(void **state) {
    (void)state;
    fill_pictures();
    const void *const from_halves[3] = {halves[0], halves[1], halves[2]};
    const void *const from_floats[3] = {floats[0], floats[1], floats[2]};
    dpl_field *a = drawn_from(from_halves, DPL_FORMAT_F16, sizeof(uint16_t));
    dpl_field *b = drawn_from(from_floats, DPL_FORMAT_F32, sizeof(float));
    int kinds[3] = {0};
    for (int y = 0; y < H; y++)
        for (int x = 0; x < W; x++) {
            dpl_material m, n;
            assert_ok(dpl_field_read_pixel(a, x, y, &m));
            assert_ok(dpl_field_read_pixel(b, x, y, &n));
            assert_memory_equal(&m, &n, sizeof m);
            kinds[dpl_material_kind(&m)]++;
        }
    assert_true(kinds[0] > 100 && kinds[1] > 100 && kinds[2] > 100);
    dpl_field_destroy(a);
    dpl_field_destroy(b);
}

static void halves_need_not_be_aligned_in_a_layer(void **state) {
    (void)state;
    static char bytes[1 + 3 * sizeof(uint16_t)];
    const uint16_t lamp[3] = {0x3c00, 0x4000, 0x7bff}; /* 1, 2, 65504 */
    memcpy(bytes + 1, lamp, sizeof lamp);
    dpl_field *field = field_of_size(4, 4);
    dpl_layer layer = dpl_layer_default();
    layer.emission = (dpl_pixels){bytes + 1, DPL_FORMAT_F16, 1, 1, 3, 0};
    assert_ok(dpl_field_draw_layer(field, &layer));
    dpl_material m;
    assert_ok(dpl_field_read_pixel(field, 0, 0, &m));
    assert_true(m.emission[0] == 1.0f && m.emission[1] == 2.0f && m.emission[2] == 65504.0f);
    dpl_field_destroy(field);
}

static void bad_halves_are_refused_with_the_pixel_named(void **state) {
    (void)state;
    static const struct {
        uint16_t half;
        const char *text;
    } bad[] = {{0xbc00, "is -1"}, {0x8001, "is -5.96046e-08"}, {0x7c00, "is inf"}, {0x7e00, "nan"}};
    static uint16_t picture[4][W];
    dpl_field *field = field_of_size(W, 4);
    dpl_layer layer = dpl_layer_default();
    layer.emission = (dpl_pixels){picture, DPL_FORMAT_F16, W, 4, 1, 0};
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        for (int p = 0; p < 4 * W; p++)
            picture[p / W][p % W] = p % 7 ? 0x3c00 : 0x8000; /* minus zero is fine */
        picture[2][259] = picture[3][1] = bad[i].half;
        assert_int_equal(dpl_field_draw_layer(field, &layer), DPL_ERROR_ARGUMENT);
        assert_non_null(strstr(dpl_context_message(context), "emission of pixel (259, 2) of the layer is"));
        assert_non_null(strstr(dpl_context_message(context), bad[i].text));
    }
    dpl_material m;
    assert_ok(dpl_field_read_pixel(field, 1, 0, &m));
    assert_true(m.extinction[0] == 0.0f); /* nothing was drawn */
    layer.emission.data = NULL;
    layer.extinction = (dpl_pixels){picture, DPL_FORMAT_F16, W, 1, 1, 0};
    layer.extinction_is_opacity = 0;
    picture[0][1] = 0x7c00; /* infinite extinction: opaque */
    assert_ok(dpl_field_draw_layer(field, &layer));
    assert_ok(dpl_field_read_pixel(field, 1, 0, &m));
    assert_true(isinf(m.extinction[0]));
    dpl_field_destroy(field);
}

/* ---- results -------------------------------------------------------------------------------------- */

static void assert_halves_are_the_floats_rounded(dpl_solver_kind kind) {
    enum { SIDE = 40, WIDE = 150 };
    static float expected[SIDE][WIDE][3];
    static uint16_t rgb[SIDE][WIDE][3], rgba[SIDE][WIDE * 4 + 3];
    dpl_field *field = dpl_test_world(context, WIDE, SIDE, 5, 1);
    dpl_shape lamp = dpl_shape_default(DPL_SHAPE_DISC);
    lamp.disc = (dpl_disc){{20, 20}, 3};
    lamp.material.emission[1] = 1e7f; /* more than a half can hold */
    assert_ok(dpl_field_draw_shapes(field, &lamp, 1));
    dpl_solver_desc desc = dpl_solver_desc_default();
    desc.kind = kind;
    desc.reference.directions = 16;
    dpl_solver *solver;
    assert_ok(dpl_solver_create(context, &desc, &solver));
    dpl_output output = {.data = expected, .width = WIDE, .height = SIDE, .channels = 3};
    assert_ok(dpl_solver_solve(solver, field, &output));
    output.format = DPL_FORMAT_F16;
    output.data = rgb;
    assert_ok(dpl_solver_solve(solver, field, &output));
    memset(rgba, 0xa5, sizeof rgba);
    output.data = rgba[SIDE - 1];
    output.channels = 4;
    output.row_stride = -(ptrdiff_t)sizeof rgba[0];
    assert_ok(dpl_solver_solve(solver, field, &output));
    int clamped = 0;
    for (int y = 0; y < SIDE; y++) {
        const uint16_t *row = rgba[SIDE - 1 - y];
        for (int i = 0; i < WIDE * 3; i++) {
            assert_int_equal(rgb[y][i / 3][i % 3], dpl_half_from_float(expected[y][i / 3][i % 3]));
            assert_int_equal(row[i / 3 * 4 + i % 3], rgb[y][i / 3][i % 3]);
            clamped += rgb[y][i / 3][i % 3] == 0x7bff;
        }
        for (int x = 0; x < WIDE; x++)
            assert_int_equal(row[4 * x + 3], 0x3c00);
        for (int i = WIDE * 4; i < WIDE * 4 + 3; i++)
            assert_int_equal(row[i], 0xa5a5); /* padding is not written */
    }
    assert_true(clamped > 20);
    dpl_solver_destroy(solver);
    dpl_field_destroy(field);
}

static void results_as_halves_are_the_floats_rounded(void **state) {
    (void)state;
    assert_halves_are_the_floats_rounded(DPL_SOLVER_CASCADES);
    assert_halves_are_the_floats_rounded(DPL_SOLVER_REFERENCE);
}

static void outputs_that_cannot_be_written_are_refused(void **state) {
    (void)state;
    static uint16_t rgb[8][8][3];
    dpl_field *field = dpl_test_world(context, 8, 8, 1, 0);
    dpl_solver *solver = dpl_test_solver(context, DPL_SOLVER_CASCADES, DPL_MERGE_BILINEAR, 0);
    const dpl_output good = {.data = rgb, .format = DPL_FORMAT_F16, .width = 8, .height = 8, .channels = 3};
    dpl_output bad = good;
    bad.format = DPL_FORMAT_SRGB8;
    assert_int_equal(dpl_solver_solve(solver, field, &bad), DPL_ERROR_ARGUMENT);
    assert_string_equal(dpl_context_message(context),
                        "the output's format is 2, not DPL_FORMAT_F32 or DPL_FORMAT_F16");
    bad = good;
    bad.data = (char *)rgb + 1;
    assert_int_equal(dpl_solver_solve(solver, field, &bad), DPL_ERROR_ARGUMENT);
    assert_string_equal(dpl_context_message(context),
                        "the output's data or stride is not a multiple of a channel's 2 bytes");
    bad = good;
    bad.row_stride = 49;
    assert_int_equal(dpl_solver_solve(solver, field, &bad), DPL_ERROR_ARGUMENT);
    bad.row_stride = 46;
    assert_int_equal(dpl_solver_solve(solver, field, &bad), DPL_ERROR_ARGUMENT);
    assert_string_equal(dpl_context_message(context), "the rows of the output overlap");
    dpl_solver_destroy(solver);
    dpl_field_destroy(field);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_layer_of_halves_is_drawn_like_one_of_floats),
        cmocka_unit_test(halves_need_not_be_aligned_in_a_layer),
        cmocka_unit_test(bad_halves_are_refused_with_the_pixel_named),
        cmocka_unit_test(results_as_halves_are_the_floats_rounded),
        cmocka_unit_test(outputs_that_cannot_be_written_are_refused),
    };
    return cmocka_run_group_tests(tests, open_context, close_context);
}
