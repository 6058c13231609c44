/* Shadows in a world larger than its picture, and pictures of halves: what every method has to respect. */
#include "field/field.h"
#include "kernel/half.h"
#include "shadow_world.h"

#include "shared_context.h"

#include <string.h>

enum { WIDTH = 37, HEIGHT = 29, MARGIN = 9, WIDE = WIDTH + 2 * MARGIN, HIGH = HEIGHT + 2 * MARGIN };

static dpl_field *field_with_margin(int32_t width, int32_t height, int32_t margin) {
    dpl_field_desc desc = dpl_field_desc_default();
    dpl_field *field;
    desc.width = width;
    desc.height = height;
    desc.margin = margin;
    assert_ok(dpl_field_create(context, &desc, &field));
    return field;
}

/* Walls in the picture and in the margin, and a medium; drawn `offset` pixels further right and down. */
static void draw_world(dpl_field *field, double offset) {
    static const double walls[][4] = {{-6, 3, -4, 12}, {14, 10, 17, 13}, {25, -7, 27, 5}, {10, 20, 44, 21}};
    for (int i = 0; i < 4; i++)
        dpl_test_block(field, walls[i][0] + offset, walls[i][1] + offset, walls[i][2] + offset,
                       walls[i][3] + offset, INFINITY);
    dpl_test_block(field, -8 + offset, 14 + offset, 6 + offset, 18 + offset, 0.1f);
}

static const double places[][3] = {{-8, 7, 1.5}, {20.5, 16.25, 4}, {40, 34, 3}, {60, -5, 6}};

static void a_shadow_is_the_crop_of_its_world(void **state) {
    (void)state;
    dpl_field *field = field_with_margin(WIDTH, HEIGHT, MARGIN), *world = field_with_margin(WIDE, HIGH, 0);
    draw_world(field, 0);
    draw_world(world, MARGIN);
    int dark = 0, lit = 0;
    for (int method = 0; method < DPL_SHADOW_METHOD_COUNT; method++)
        for (int k = 0; k < 4; k++) {
            dpl_shadow_desc desc = dpl_test_method((dpl_shadow_method)method);
            desc.samples = 16;
            dpl_light light = dpl_test_light(places[k][0], places[k][1], places[k][2]);
            float *shown = dpl_test_visibility(context, field, &light, &desc);
            light.position[0] += MARGIN;
            light.position[1] += MARGIN;
            float *whole = dpl_test_visibility(context, world, &light, &desc);
            for (int y = 0; y < HEIGHT; y++)
                assert_memory_equal(shown + y * WIDTH, whole + (y + MARGIN) * WIDE + MARGIN,
                                    WIDTH * sizeof *shown);
            for (int i = 0; i < WIDTH * HEIGHT; i++) {
                dark += shown[i] == 0.0f;
                lit += shown[i] == 1.0f;
            }
            free(shown);
            free(whole);
        }
    assert_true(dark > 1000 && lit > 1000);
    dpl_field_destroy(field);
    dpl_field_destroy(world);
}

static void a_wall_in_the_margin_throws_its_shadow(void **state) {
    (void)state;
    dpl_field *field = field_with_margin(WIDTH, HEIGHT, MARGIN);
    dpl_test_block(field, -3, -9, -2, HEIGHT + 9, INFINITY);
    dpl_light light = dpl_test_light(-7, 14, 1);
    dpl_shadow_desc desc = dpl_shadow_desc_default();
    float *v = dpl_test_visibility(context, field, &light, &desc);
    for (int i = 0; i < WIDTH * HEIGHT; i++)
        assert_true(v[i] == 0.0f);
    free(v);
    dpl_field_destroy(field);
}

static void light_of_a_field(dpl_field *field, dpl_format format, int32_t channels, void *data) {
    dpl_shadow_desc desc = dpl_shadow_desc_default();
    dpl_light lights[2] = {dpl_test_light(-8, 7, 1.5), dpl_test_light(20.5, 16.25, 4)};
    dpl_output output = {
        .data = data, .width = WIDTH, .height = HEIGHT, .channels = channels, .format = format};
    dpl_shadow *shadow;
    assert_ok(dpl_shadow_create(context, &desc, &shadow));
    assert_ok(dpl_shadow_light(shadow, field, lights, 2, &output));
    dpl_shadow_destroy(shadow);
}

static void light_in_halves_is_the_light_in_floats_rounded(void **state) {
    (void)state;
    static float floats[HEIGHT * WIDTH * 4];
    static uint16_t halves[HEIGHT * WIDTH * 4];
    dpl_field *field = field_with_margin(WIDTH, HEIGHT, MARGIN);
    draw_world(field, 0);
    for (int32_t channels = 3; channels <= 4; channels++) {
        int shining = 0;
        light_of_a_field(field, DPL_FORMAT_F32, channels, floats);
        light_of_a_field(field, DPL_FORMAT_F16, channels, halves);
        for (int i = 0; i < HEIGHT * WIDTH * channels; i++) {
            assert_int_equal(halves[i], dpl_half_from_float(floats[i]));
            shining += floats[i] > 0.0f;
        }
        assert_true(shining > 1000);
    }
    dpl_field_destroy(field);
}

static void bytes_are_refused_with_a_message(void **state) {
    (void)state;
    static uint8_t bytes[HEIGHT * WIDTH * 3];
    dpl_field *field = field_with_margin(WIDTH, HEIGHT, MARGIN);
    dpl_shadow_desc desc = dpl_shadow_desc_default();
    dpl_output output = {
        .data = bytes, .width = WIDTH, .height = HEIGHT, .channels = 3, .format = DPL_FORMAT_SRGB8};
    dpl_shadow *shadow;
    assert_ok(dpl_shadow_create(context, &desc, &shadow));
    assert_int_equal(dpl_shadow_light(shadow, field, NULL, 0, &output), DPL_ERROR_ARGUMENT);
    assert_non_null(strstr(dpl_context_message(context), "DPL_FORMAT_F16"));
    dpl_shadow_destroy(shadow);
    dpl_field_destroy(field);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_shadow_is_the_crop_of_its_world),
        cmocka_unit_test(a_wall_in_the_margin_throws_its_shadow),
        cmocka_unit_test(light_in_halves_is_the_light_in_floats_rounded),
        cmocka_unit_test(bytes_are_refused_with_a_message),
    };
    return cmocka_run_group_tests(tests, open_context, close_context);
}
