/* From a scene to its field: sky, images under shapes, sizes, and what the library refuses said in the
 * scene's error. */
#include "shared_context.h"
#include "testing.h"

#include "../../scenes/families.h"

#include <dapple/dapple.h>

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

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_family_becomes_a_field_with_walls_and_room),
        cmocka_unit_test(images_lie_under_shapes),
    };
    return cmocka_run_group_tests(tests, open_context, close_context);
}
