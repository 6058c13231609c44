/* From a scene to its field: sky, images under shapes, sizes, and what the library refuses said in the
 * scene's error. */
#include "shared_context.h"
#include "testing.h"

#include "../../scenes/families.h"

#include <dapple/dapple.h>
#include <math.h>

static int64_t count_opaque(dpl_field *field) {
    int64_t count = 0;
    for (int32_t y = 0; y < dpl_field_height(field); y++)
        for (int32_t x = 0; x < dpl_field_width(field); x++) {
            dpl_material m;
            assert_ok(dpl_field_read_pixel(field, x, y, &m));
            count += m.extinction[0] > 1e30f;
        }
    return count;
}

static void every_family_becomes_a_field_with_walls_and_room(void **state) {
    (void)state;
    int32_t family_count;
    const dpl_scene_family *families = dpl_scene_families(&family_count);
    for (int32_t f = 0; f < family_count; f++)
        for (int32_t i = 0; i < families[f].count; i += 7) {
            dpl_scene scene = {0};
            dpl_field *field;
            dpl_error error;
            assert_true(families[f].make(3, i, 96, &scene, &error));
            assert_true(dpl_scene_build_field(&scene, context, false, &field, &error));
            int64_t opaque = count_opaque(field);
            assert_true(opaque > 0 && opaque < (int64_t)scene.width * scene.height * 9 / 10);
            dpl_field_destroy(field);
            dpl_scene_free(&scene);
        }
}

static void images_lie_under_shapes(void **state) {
    (void)state;
    dpl_scene scene = {.width = 8, .height = 4};
    dpl_error error;
    dpl_field *field;
    dpl_scene_image image = {.at = {1, 1}, .intensity = 2.0};
    assert_true(dpl_picture_create(&image.emission_picture, 4, 2, 3, &error));
    for (int i = 0; i < 4 * 2 * 3; i++)
        image.emission_picture.data[i] = 0.5f;
    scene.images = &image;
    scene.image_count = 1;
    scene.sky[1] = 0.25;
    dpl_shape wall = dpl_shape_default(DPL_SHAPE_BOX);
    wall.box = (dpl_box){{2.5, 1.5}, {0.5, 0.5}, 0.0};
    scene.shapes = &wall;
    scene.shape_count = 1;
    assert_true(dpl_scene_build_field(&scene, context, false, &field, &error));
    dpl_material m;
    assert_ok(dpl_field_read_pixel(field, 1, 1, &m));
    assert_true(m.emission[0] == 1.0f);
    assert_ok(dpl_field_read_pixel(field, 2, 1, &m));
    assert_true(m.emission[0] == 0.0f && m.extinction[0] > 1e30f);
    assert_ok(dpl_field_read_pixel(field, 0, 0, &m));
    assert_true(m.extinction[0] == 0.0f);
    /* A field that keeps distances to shapes cannot hold pictures, and says so. */
    dpl_field *with_distance;
    assert_false(dpl_scene_build_field(&scene, context, true, &with_distance, &error));
    assert_null(with_distance);
    assert_non_null(strstr(error.text, "takes no layers"));
    scene.width = 9;
    assert_false(dpl_scene_draw(&scene, context, field, &error));
    assert_non_null(strstr(error.text, "9x4"));
    dpl_field_destroy(field);
    dpl_picture_free(&image.emission_picture);
}

static void the_sky_and_the_margin_reach_the_field(void **state) {
    (void)state;
    double ring[2][3] = {{0, 0, 1}, {2, 0, 0}};
    dpl_scene scene = {.width = 5, .height = 3, .margin = 7, .sky_ring = ring, .sky_sectors = 2};
    dpl_error error;
    dpl_field *field;
    dpl_shape lamp = dpl_shape_default(DPL_SHAPE_BOX);
    lamp.box = (dpl_box){{2.5, 5.5}, {9.5, 0.5}, 0.0}; /* a floor below the picture */
    lamp.material.emission[1] = 1.0f;
    scene.shapes = &lamp;
    scene.shape_count = 1;
    assert_true(dpl_scene_build_field(&scene, context, false, &field, &error));
    assert_int_equal(dpl_field_margin(field), 7);
    dpl_solver_desc desc = dpl_solver_desc_default();
    dpl_solver *solver;
    float rgb[5 * 3 * 3];
    dpl_output output = {.data = rgb, .width = 5, .height = 3, .channels = 3};
    desc.kind = DPL_SOLVER_REFERENCE;
    assert_ok(dpl_solver_create(context, &desc, &solver));
    assert_ok(dpl_solver_solve(solver, field, &output));
    const float *centre = rgb + 3 * (1 * 5 + 2);
    double floor_share = 2.0 * atan2(9.5, 3.5) / 6.283185307179586;
    assert_float_equal(centre[0], 1.0f, 1e-6f);                      /* the upper half is red */
    assert_float_equal(centre[1], (float)floor_share, 1e-3f);        /* below, the green floor ... */
    assert_float_equal(centre[2], 0.5f - (float)floor_share, 1e-3f); /* ... hides most of the blue */
    scene.margin = 6;
    assert_false(dpl_scene_draw(&scene, context, field, &error));
    assert_string_equal(error.text, "the scene has a margin of 6 px, but the field one of 7 px");
    dpl_solver_destroy(solver);
    dpl_field_destroy(field);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_family_becomes_a_field_with_walls_and_room),
        cmocka_unit_test(images_lie_under_shapes),
        cmocka_unit_test(the_sky_and_the_margin_reach_the_field),
    };
    return cmocka_run_group_tests(tests, open_context, close_context);
}
