/* The tone map: its formula, what counts as zero, layouts of input and output, and what is refused. */
#include "testing.h"

#include <dapple/dapple.h>

#include <math.h>
#include <string.h>

enum {
    WIDTH = 300,
    HEIGHT = 5,
    ROW = 3 * WIDTH,
    VALUES = ROW * HEIGHT
}; /* wider than any block that rows are packed in */

static int make_context(void **state) {
    return dpl_context_create(NULL, (dpl_context **)state) == DPL_OK ? 0 : -1;
}

static int end_context(void **state) {
    dpl_context_destroy(*state);
    return 0;
}

/* Values from 0 up to about 3, all different. */
static void fill(float picture[VALUES]) {
    for (int i = 0; i < VALUES; i++)
        picture[i] = 3.0f * (float)i / (float)VALUES;
}

static dpl_pixels view(const void *data, int32_t width, int32_t height, int32_t channels) {
    return (dpl_pixels){.data = data, .width = width, .height = height, .channels = channels};
}

static void values_are_the_formula_rounded(void **state) {
    static float picture[VALUES];
    static uint8_t rgb[VALUES];
    fill(picture);
    const dpl_pixels linear = view(picture, WIDTH, HEIGHT, 3);
    assert_ok(dpl_tonemap(*state, &linear, rgb, 0));
    for (int i = 0; i < VALUES; i++) {
        const double m = (double)picture[i];
        const double exact = 255.0 * (1.0 - pow(1.0 + 2.0 * 3.14159265358979323846 * m, -2.5));
        assert_true(fabs((double)rgb[i] - exact) <= 0.5 + 1e-4);
    }
}

static void black_white_negative_and_not_finite_have_their_values(void **state) {
    const float values[6] = {0.0f, -3.0f, NAN, INFINITY, 1e30f, -INFINITY};
    const uint8_t expected[6] = {0, 0, 0, 255, 255, 0};
    uint8_t rgb[6];
    const dpl_pixels linear = view(values, 2, 1, 3);
    assert_ok(dpl_tonemap(*state, &linear, rgb, 0));
    assert_memory_equal(rgb, expected, sizeof rgb);
}

static void a_fourth_channel_and_strides_change_nothing(void **state) {
    enum { PITCH = ROW + 5 };
    static float picture[VALUES], flipped[HEIGHT][WIDTH][4];
    static uint8_t tight[VALUES], wide[HEIGHT][PITCH];
    fill(picture);
    for (int y = 0; y < HEIGHT; y++)
        for (int x = 0; x < WIDTH; x++) {
            memcpy(flipped[HEIGHT - 1 - y][x], picture + y * ROW + 3 * x, 3 * sizeof(float));
            flipped[HEIGHT - 1 - y][x][3] = NAN;
        }
    memset(wide, 0xa5, sizeof wide);
    const dpl_pixels plain = view(picture, WIDTH, HEIGHT, 3);
    dpl_pixels other = view(flipped[HEIGHT - 1], WIDTH, HEIGHT, 4);
    other.row_stride = -(ptrdiff_t)sizeof flipped[0];
    assert_ok(dpl_tonemap(*state, &plain, tight, 0));
    assert_ok(dpl_tonemap(*state, &other, wide[HEIGHT - 1], -PITCH));
    for (int y = 0; y < HEIGHT; y++) {
        assert_memory_equal(wide[HEIGHT - 1 - y], tight + y * ROW, ROW);
        for (int i = ROW; i < PITCH; i++)
            assert_int_equal(wide[y][i], 0xa5); /* padding is not written */
    }
}

static void what_cannot_be_read_or_written_is_refused_and_nothing_is_written(void **state) {
    const float picture[6] = {0};
    uint8_t rgb[6], before[6];
    memset(rgb, 0xa5, sizeof rgb);
    memcpy(before, rgb, sizeof rgb);
    const dpl_pixels good = view(picture, 2, 1, 3);
    assert_int_equal(dpl_tonemap(NULL, &good, rgb, 0), DPL_ERROR_ARGUMENT);
    assert_int_equal(dpl_tonemap(*state, NULL, rgb, 0), DPL_ERROR_ARGUMENT);
    assert_int_equal(dpl_tonemap(*state, &good, NULL, 0), DPL_ERROR_ARGUMENT);
    assert_int_equal(dpl_tonemap(*state, &good, rgb, 5), DPL_ERROR_ARGUMENT);
    assert_string_equal(dpl_context_message(*state), "row_stride 5 is shorter than a row of 6 bytes");
    dpl_pixels bad[5] = {good, good, good, good, good};
    bad[0].data = NULL;
    bad[1].format = DPL_FORMAT_UNORM8;
    bad[2].channels = 2;
    bad[3].width = 0;
    bad[4].row_stride = 8;
    for (int i = 0; i < 5; i++)
        assert_int_equal(dpl_tonemap(*state, &bad[i], rgb, 0), DPL_ERROR_ARGUMENT);
    assert_memory_equal(rgb, before, sizeof rgb);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(values_are_the_formula_rounded),
        cmocka_unit_test(black_white_negative_and_not_finite_have_their_values),
        cmocka_unit_test(a_fourth_channel_and_strides_change_nothing),
        cmocka_unit_test(what_cannot_be_read_or_written_is_refused_and_nothing_is_written),
    };
    return cmocka_run_group_tests(tests, make_context, end_context);
}
