/* What is written reads back to the last bit, and what cannot be said is refused. */
#include "scene_same.h"

#include "../../scenes/number_text.h"
#include "../../scenes/random.h"

#include <float.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void assert_round_trip(const dpl_scene *scene, const char *path) {
    dpl_error error = {.text = ""};
    dpl_scene back;
    if (!dpl_scene_write(path, scene, &error) || !dpl_scene_read(path, &back, &error))
        fail_msg("%s", error.text);
    assert_same_scene(scene, &back);
    dpl_scene_free(&back);
    remove(path);
}

static void every_kind_of_shape_reads_back(void **state) {
    (void)state;
    static const double points[4][2] = {{0.1, -0.2}, {1.0 / 3, 1e-300}, {-1e9, 1e9}, {5, 6}};
    dpl_scene scene = {.width = 3, .height = 16384, .sky = {0.1, 1.0 / 3, 1e-310}};
    for (int kind = DPL_SHAPE_DISC; kind <= DPL_SHAPE_SEGMENT; kind++) {
        dpl_shape shape = dpl_shape_default((dpl_shape_kind)kind);
        if (kind == DPL_SHAPE_DISC) {
            shape.disc = (dpl_disc){{DBL_MIN, -0.0}, 2.0 / 3};
            shape.material.emission[1] = FLT_MIN;
        } else if (kind == DPL_SHAPE_BOX) {
            shape.box = (dpl_box){{1e-5, 123456789.125}, {0, 7}, -3.141592653589793};
            shape.material.extinction[0] = 1e-40f;
            shape.material.extinction[1] = 0;
            shape.material.extinction[2] = 1e9f;
        } else if (kind == DPL_SHAPE_POLYGON) {
            shape.polygon = (dpl_polygon){points, 4};
            shape.material.albedo[2] = 1.0f / 3;
        } else {
            shape.segment = (dpl_segment){{1, 2}, {3, 4}, 0.1};
            shape.material.emission[0] = 16777217.0f;
        }
        assert_true(dpl_scene_add_shape(&scene, &shape, NULL));
    }
    assert_round_trip(&scene, "scene-write-shapes.json");
    dpl_scene_free(&scene);
}

static void lights_and_an_empty_scene_read_back(void **state) {
    (void)state;
    dpl_scene_light lights[2] = {{{0.1, 0.2}, 0.3, {0.4, 0.5, 0.6}, 0.7}, {{-1, -2}, 0, {1, 1, 1}, 1e9}};
    dpl_scene scene = {.width = 1, .height = 1};
    assert_round_trip(&scene, "scene-write-empty.json");
    scene.lights = lights;
    scene.light_count = 2;
    assert_round_trip(&scene, "scene-write-lights.json");
}

static void a_ring_of_sky_and_a_margin_read_back(void **state) {
    (void)state;
    double ring[3][3] = {{0.1, 1.0 / 3, 1e-310}, {0, 0, 0}, {1e9, 5, 0.7}};
    dpl_scene scene = {.width = 8192, .height = 2, .margin = 4096, .sky_ring = ring, .sky_sectors = 3};
    assert_round_trip(&scene, "scene-write-ring.json");
    scene.sky_sectors = 1;
    assert_round_trip(&scene, "scene-write-ring.json");
}

static void names_of_pictures_are_escaped(void **state) {
    (void)state;
    static const uint8_t bytes[3] = {1, 2, 3};
    char name[] = "scene-write \"\\ \xc3\xa9.png", path[] = "scene-write-names.json";
    dpl_error error = {.text = ""};
    assert_true(dpl_picture_write_png(name, 1, 1, 3, bytes, &error));
    dpl_scene_image image = {.emission = name, .at = {-7, 8}, .intensity = 0.1};
    assert_true(dpl_picture_read(name, DPL_PICTURE_LINEAR, &image.emission_picture, &error));
    dpl_scene scene = {.width = 4, .height = 4, .images = &image, .image_count = 1};
    assert_round_trip(&scene, path);
    dpl_picture_free(&image.emission_picture);
    remove(name);
}

static void what_the_format_cannot_say_is_refused(void **state) {
    (void)state;
    float value = 1;
    dpl_error error = {.text = ""};
    dpl_shape shape = dpl_shape_default(DPL_SHAPE_DISC);
    dpl_scene scene = {.width = 4, .height = 4, .shapes = &shape, .shape_count = 1};
    shape.material.extinction[1] = 0;
    assert_false(dpl_scene_write("scene-write-not.json", &scene, &error));
    assert_string_equal(
        error.text, "scene-write-not.json: shapes[0]: opaque to some colours only, which cannot be written");
    dpl_scene_image image = {.emission_picture = {1, 1, 1, &value, false}, .intensity = 1};
    dpl_scene nameless = {.width = 4, .height = 4, .images = &image, .image_count = 1};
    assert_false(dpl_scene_write("scene-write-not.json", &nameless, &error));
    assert_string_equal(error.text,
                        "scene-write-not.json: images[0]: a picture without a name cannot be written");
    char bad[] = "\xff.png";
    image.emission = bad;
    assert_false(dpl_scene_write("scene-write-not.json", &nameless, &error));
    assert_null(fopen("scene-write-not.json", "r"));
    assert_false(dpl_scene_write("no-such-folder/a.json", &(dpl_scene){.width = 1, .height = 1}, &error));
}

static void numbers_are_short_and_exact(void **state) {
    (void)state;
    assert_string_equal(dpl_number_text_double(0.1).text, "0.1");
    assert_string_equal(dpl_number_text_double(1.0 / 3).text, "0.3333333333333333");
    assert_string_equal(dpl_number_text_double(-3).text, "-3");
    assert_string_equal(dpl_number_text_double(-0.0).text, "-0");
    assert_string_equal(dpl_number_text_float(0.1f).text, "0.1");
    dpl_random random = dpl_random_start(1, 2);
    for (int i = 0; i < 20000; i++) {
        uint64_t bits = dpl_random_bits(&random) & 0xffefffffffffffffu; /* never infinite nor a NaN */
        uint32_t half = (uint32_t)bits & 0xff7fffffu;
        double number, back;
        float small, small_back;
        memcpy(&number, &bits, sizeof number);
        memcpy(&small, &half, sizeof small);
        back = strtod(dpl_number_text_double(number).text, NULL);
        small_back = (float)strtod(dpl_number_text_float(small).text, NULL);
        assert_memory_equal(&number, &back, sizeof number);
        assert_memory_equal(&small, &small_back, sizeof small);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_kind_of_shape_reads_back),
        cmocka_unit_test(lights_and_an_empty_scene_read_back),
        cmocka_unit_test(a_ring_of_sky_and_a_margin_read_back),
        cmocka_unit_test(names_of_pictures_are_escaped),
        cmocka_unit_test(what_the_format_cannot_say_is_refused),
        cmocka_unit_test(numbers_are_short_and_exact),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
