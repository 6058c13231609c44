/* A world larger than its picture: what is in the margin acts, and nothing of it is shown. */
#include "truth.h"

enum { WIDTH = 40, HEIGHT = 26, MARGIN = 11, WIDE = WIDTH + 2 * MARGIN, HIGH = HEIGHT + 2 * MARGIN };

/* Something of everything, drawn `offset` pixels further right and down; parts of it in the margin. */
static void draw_world(dpl_field *field, double offset) {
    static const double boxes[][4] = {{-8, 3, -5, 9},   {30, -9, 33, 4},    {5, 5, 12, 8},
                                      {20, 22, 48, 25}, {-11, -11, -9, 37}, {44, 30, 51, 37}};
    dpl_shape disc = dpl_shape_default(DPL_SHAPE_DISC), line = dpl_shape_default(DPL_SHAPE_SEGMENT);
    for (int i = 0; i < 6; i++) {
        dpl_material material = truth_wall(i % 2 ? 0.0 : 1.0 + i, 0.7);
        truth_box(field, boxes[i][0] + offset, boxes[i][1] + offset, boxes[i][2] + offset,
                  boxes[i][3] + offset, material);
    }
    disc.disc = (dpl_disc){{20.25 + offset, -4.5 + offset}, 5.75};
    disc.material.extinction[0] = disc.material.extinction[1] = disc.material.extinction[2] = 0.125f;
    line.segment = (dpl_segment){{-6.5 + offset, 30.5 + offset}, {46.5 + offset, 12.5 + offset}, 1.5};
    line.material.albedo[1] = 0.5f;
    assert_ok(dpl_field_draw_shapes(field, &disc, 1));
    assert_ok(dpl_field_draw_shapes(field, &line, 1));
    truth_sky_quarters(field, 3, 4, 0.25f);
}

static float shown[HEIGHT][WIDTH][3], whole[HIGH][WIDE][3];

static void assert_is_the_crop(void) {
    for (int32_t y = 0; y < HEIGHT; y++)
        assert_memory_equal(shown[y], whole[y + MARGIN][MARGIN], sizeof shown[y]);
}

static void a_picture_is_the_crop_of_its_world(void **state) {
    (void)state;
    dpl_field *field = truth_field(WIDTH, HEIGHT, MARGIN), *world = truth_field(WIDE, HIGH, 0);
    draw_world(field, 0);
    draw_world(world, MARGIN);
    for (int kind = 0; kind < 5; kind++) {
        dpl_solver_desc desc = dpl_solver_desc_default();
        dpl_solver *solver;
        desc.kind = kind < 2 ? DPL_SOLVER_REFERENCE : DPL_SOLVER_CASCADES;
        desc.reference.directions = 48;
        desc.bounces = kind == 1 ? 2 : 0;
        desc.cascades.merge = kind < 2 ? DPL_MERGE_BILINEAR : (dpl_merge)(kind - 2);
        assert_ok(dpl_solver_create(context, &desc, &solver));
        dpl_output small = {.data = &shown[0][0][0], .width = WIDTH, .height = HEIGHT, .channels = 3},
                   large = {.data = &whole[0][0][0], .width = WIDE, .height = HIGH, .channels = 3};
        assert_ok(dpl_solver_solve(solver, field, &small));
        assert_ok(dpl_solver_solve(solver, world, &large));
        assert_is_the_crop();
        assert_true(shown[13][20][0] > 0.01f);
        dpl_solver_destroy(solver);
    }
    dpl_field_destroy(field);
    dpl_field_destroy(world);
}

static void the_paper_profile_crops_too(void **state) {
    (void)state;
    dpl_field *fields[2];
    dpl_solver_desc desc = dpl_solver_desc_default();
    dpl_solver *solver;
    desc.kind = DPL_SOLVER_CASCADES;
    desc.cascades.profile = DPL_PROFILE_PAPER;
    desc.cascades.merge = DPL_MERGE_BILINEAR;
    assert_ok(dpl_solver_create(context, &desc, &solver));
    for (int i = 0; i < 2; i++) {
        dpl_field_desc field_desc = dpl_field_desc_default();
        field_desc.width = i ? WIDE : WIDTH;
        field_desc.height = i ? HIGH : HEIGHT;
        field_desc.margin = i ? 0 : MARGIN;
        field_desc.keep_shape_distance = 1;
        assert_ok(dpl_field_create(context, &field_desc, &fields[i]));
        draw_world(fields[i], i ? MARGIN : 0);
        dpl_output output = {.data = i ? &whole[0][0][0] : &shown[0][0][0],
                             .width = field_desc.width,
                             .height = field_desc.height,
                             .channels = 3};
        assert_ok(dpl_solver_solve(solver, fields[i], &output));
        dpl_field_destroy(fields[i]);
    }
    assert_is_the_crop();
    dpl_solver_destroy(solver);
}

static void a_lamp_in_the_margin_lights_the_picture(void **state) {
    (void)state;
    static uint8_t opaque[HEIGHT][WIDTH];
    dpl_field *field = truth_field(WIDTH, HEIGHT, MARGIN);
    truth_box(field, -7, 10, -4, 16, truth_wall(1.0, 0.0));
    assert_ok(dpl_field_read_opaque(field, &opaque[0][0], 0));
    truth_solve(field, 4096, 0, &shown[0][0][0]);
    for (int32_t y = 0; y < HEIGHT; y++)
        for (int32_t x = 0; x < WIDTH; x++) {
            assert_int_equal(opaque[y][x], 0);
            assert_true(shown[y][x][0] > 0.0f);
        }
    for (int32_t x = 0; x < WIDTH; x += 7) /* 3 px to either side, seen from x + .5 + 4 px away */
        truth_assert_near((double)shown[12][x][0],
                          (atan2(3.5, x + 4.5) + atan2(2.5, x + 4.5)) / (2.0 * TRUTH_PI), 1.0 / 4096);
    dpl_field_destroy(field);
}

static void everything_is_read_in_coordinates_of_the_picture(void **state) {
    (void)state;
    static float distance[HEIGHT][WIDTH];
    dpl_material material;
    dpl_field *field = truth_field(WIDTH, HEIGHT, MARGIN);
    assert_int_equal(dpl_field_width(field), WIDTH);
    assert_int_equal(dpl_field_height(field), HEIGHT);
    truth_box(field, 3, 4, 4, 5, truth_wall(2.0, 0.0));
    truth_box(field, WIDTH + 2, 0, WIDTH + 3, HEIGHT, truth_wall(0.0, 0.0)); /* in the margin */
    assert_ok(dpl_field_read_pixel(field, 3, 4, &material));
    assert_true(material.emission[0] == 2.0f);
    assert_ok(dpl_field_read_pixel(field, WIDTH - 1, HEIGHT - 1, &material));
    assert_true(material.extinction[0] == 0.0f);
    assert_int_equal(dpl_field_read_pixel(field, WIDTH, 0, &material), DPL_ERROR_ARGUMENT);
    assert_int_equal(dpl_field_read_pixel(field, -1, 0, &material), DPL_ERROR_ARGUMENT);
    assert_ok(dpl_field_read_distance(field, &distance[0][0], 0));
    truth_assert_near((double)distance[4][3], 0.0, 0.0);
    truth_assert_near((double)distance[4][8], 5.0, 0.0);
    truth_assert_near((double)distance[20][WIDTH - 1], 3.0, 0.0); /* to the wall in the margin */
    const int32_t pixels[3][2] = {{0, 4}, {WIDTH - 1, HEIGHT - 1}, {WIDTH, 0}};
    float rgb[3][3];
    dpl_solver *solver = truth_solver(512, 0);
    assert_ok(dpl_reference_solve_pixels(solver, field, pixels, 2, rgb));
    assert_int_equal(dpl_reference_solve_pixels(solver, field, pixels, 3, rgb), DPL_ERROR_ARGUMENT);
    truth_assert_near((double)rgb[0][0], 2.0 * 2.0 * atan2(0.5, 2.5) / (2.0 * TRUTH_PI), 4.0 / 512);
    dpl_output wrong = {.data = &whole[0][0][0], .width = WIDE, .height = HIGH, .channels = 3};
    assert_int_equal(dpl_solver_solve(solver, field, &wrong), DPL_ERROR_SIZE);
    dpl_solver_destroy(solver);
    dpl_field_destroy(field);
}

static void a_layer_reaches_into_the_margin_and_no_further(void **state) {
    (void)state;
    static float emission[HIGH + 20][WIDE + 20][3];
    for (int32_t y = 0; y < HIGH + 20; y++)
        for (int32_t x = 0; x < WIDE + 20; x++)
            emission[y][x][0] = 1.0f + (float)(y * 100 + x);
    dpl_field *field = truth_field(WIDTH, HEIGHT, MARGIN);
    dpl_layer layer = dpl_layer_default();
    layer.emission = (dpl_pixels){emission, DPL_FORMAT_F32, WIDE + 20, HIGH + 20, 3, 0};
    layer.x = -MARGIN - 7;
    layer.y = -MARGIN - 9;
    assert_ok(dpl_field_draw_layer(field, &layer));
    for (int32_t y = 0; y < HEIGHT; y += 5)
        for (int32_t x = 0; x < WIDTH; x += 3) {
            dpl_material material;
            assert_ok(dpl_field_read_pixel(field, x, y, &material));
            truth_assert_near((double)material.emission[0], emission[y + MARGIN + 9][x + MARGIN + 7][0], 0.0);
        }
    layer.x = INT32_MAX; /* far off on either side: nothing to draw */
    assert_ok(dpl_field_draw_layer(field, &layer));
    layer.x = INT32_MIN;
    assert_ok(dpl_field_draw_layer(field, &layer));
    dpl_field_destroy(field);

    /* One lamp of one pixel, in the margin's last corner. */
    field = truth_field(WIDTH, HEIGHT, MARGIN);
    layer.emission.width = layer.emission.height = 1;
    layer.x = WIDTH + MARGIN - 1;
    layer.y = HEIGHT + MARGIN - 1;
    assert_ok(dpl_field_draw_layer(field, &layer));
    truth_solve(field, 256, 0, &shown[0][0][0]);
    assert_true(shown[HEIGHT - 1][WIDTH - 1][0] > 0.0f);
    dpl_field_destroy(field);
}

static void margins_that_do_not_fit_are_refused(void **state) {
    (void)state;
    static const struct {
        int32_t width, height, margin;
        const char *text;
    } cases[] = {
        {8, 8, -1, "the margin is 0 .. 4096 pixels, not -1"},
        {8, 8, 4097, "the margin is 0 .. 4096 pixels, not 4097"},
        {16384, 1, 1, "with a margin of 1, 16384 x 1 pixels are more than 16384 a side"},
        {1, 8193, 4096, "with a margin of 4096, 1 x 8193 pixels are more than 16384 a side"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        dpl_field_desc desc = dpl_field_desc_default();
        dpl_field *field;
        desc.width = cases[i].width;
        desc.height = cases[i].height;
        desc.margin = cases[i].margin;
        assert_int_equal(dpl_field_create(context, &desc, &field), DPL_ERROR_SIZE);
        assert_null(field);
        assert_string_equal(dpl_context_message(context), cases[i].text);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_picture_is_the_crop_of_its_world),
        cmocka_unit_test(the_paper_profile_crops_too),
        cmocka_unit_test(a_lamp_in_the_margin_lights_the_picture),
        cmocka_unit_test(everything_is_read_in_coordinates_of_the_picture),
        cmocka_unit_test(a_layer_reaches_into_the_margin_and_no_further),
        cmocka_unit_test(margins_that_do_not_fit_are_refused),
    };
    return cmocka_run_group_tests(tests, open_context, close_context);
}
