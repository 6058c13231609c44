/* A scene file becomes the scene it describes, and any PNG is a scene. */
#include "testing.h"

#include "../../scenes/scene.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void read_text(const char *text, dpl_scene *scene) {
    dpl_error error = {.text = ""};
    if (!dpl_scene_read_memory(text, strlen(text), "a.json", scene, &error))
        fail_msg("%s", error.text);
}

static void assert_rgb(const float rgb[3], double red, double green, double blue) {
    assert_float_equal(rgb[0], red, 0);
    assert_float_equal(rgb[1], green, 0);
    assert_float_equal(rgb[2], blue, 0);
}

static void every_key_arrives_where_it_belongs(void **state) {
    (void)state;
    dpl_scene scene;
    dpl_error error = {.text = ""};
    assert_true(dpl_scene_read(DPL_TEST_DATA "/scene/all.json", &scene, &error));
    assert_int_equal(scene.width, 512);
    assert_int_equal(scene.height, 256);
    assert_float_equal(scene.sky[1], 0.03, 0);
    assert_int_equal(scene.shape_count, 6);
    const dpl_shape *s = scene.shapes;
    assert_int_equal(s[0].kind, DPL_SHAPE_DISC);
    assert_float_equal(s[0].disc.center[1], 256, 0);
    assert_float_equal(s[0].disc.radius, 12, 0);
    assert_rgb(s[0].material.emission, 1, 0.8f, 0.5);
    assert_rgb(s[0].material.extinction, INFINITY, INFINITY, INFINITY);
    assert_int_equal(s[1].kind, DPL_SHAPE_BOX);
    assert_float_equal(s[1].box.half[1], 45, 0);
    assert_float_equal(s[1].box.angle, 0.3, 0);
    assert_rgb(s[1].material.emission, 0, 0, 0);
    assert_int_equal(s[2].kind, DPL_SHAPE_POLYGON);
    assert_int_equal(s[2].polygon.count, 3);
    assert_float_equal(s[2].polygon.points[2][1], 80, 0);
    assert_rgb(s[2].material.albedo, 0.8f, 0.2f, 0.2f);
    assert_int_equal(s[3].kind, DPL_SHAPE_SEGMENT);
    assert_float_equal(s[3].segment.to[0], 511, 0);
    assert_float_equal(s[3].segment.width, 3, 0);
    assert_rgb(s[3].material.extinction, 0.05f, 0.05f, 0.05f);
    assert_rgb(s[4].material.extinction, 0.1f, 0, 1e9);
    assert_rgb(s[4].material.emission, 2, 2, 2);
    assert_rgb(s[5].material.extinction, INFINITY, INFINITY, INFINITY);
    assert_rgb(s[5].material.albedo, 1, 1, 1);
    dpl_scene_free(&scene);
}

static void lights_arrive_with_their_defaults(void **state) {
    (void)state;
    dpl_scene scene;
    dpl_error error = {.text = ""};
    assert_true(dpl_scene_read(DPL_TEST_DATA "/scene/all.json", &scene, &error));
    assert_int_equal(scene.light_count, 2);
    assert_float_equal(scene.lights[0].color[2], 0.9, 0);
    assert_float_equal(scene.lights[0].intensity, 3, 0);
    assert_float_equal(scene.lights[1].position[1], 2, 0);
    assert_float_equal(scene.lights[1].color[2], 1, 0);
    assert_float_equal(scene.lights[1].intensity, 1, 0);
    dpl_scene_free(&scene);
}

static void defaults_fill_what_is_left_out(void **state) {
    (void)state;
    dpl_scene scene;
    read_text(
        "{\"dapple\":1.0,\"size\":[1,16384],\"sky\":0.5,\"shapes\":[{\"segment\":{\"from\":[0,0],\"to\":"
        "[1,1]}},{\"box\":{\"center\":[0,0],\"half\":[1,1]}}]}",
        &scene);
    assert_float_equal(scene.sky[2], 0.5, 0);
    assert_float_equal(scene.shapes[0].segment.width, 1, 0);
    assert_float_equal(scene.shapes[1].box.angle, 0, 0);
    dpl_scene_free(&scene);
    read_text("\xef\xbb\xbf{\"dapple\":1,\"size\":[8,8]}", &scene);
    assert_float_equal(scene.sky[0], 0, 0);
    assert_int_equal(scene.image_count + scene.shape_count + scene.light_count, 0);
    dpl_scene_free(&scene);
}

static void a_sky_is_one_colour_or_a_ring(void **state) {
    (void)state;
    dpl_scene scene;
    read_text("{\"dapple\":1,\"size\":[8,8192],\"margin\":4096.0,\"sky\":[[1,2,3],[0,0.5,0]]}", &scene);
    assert_int_equal(scene.margin, 4096);
    assert_int_equal(scene.sky_sectors, 2);
    assert_float_equal(scene.sky_ring[0][2], 3, 0);
    assert_float_equal(scene.sky_ring[1][1], 0.5, 0);
    dpl_scene_free(&scene);
    read_text("{\"dapple\":1,\"size\":[8,8],\"sky\":[1,2,3]}", &scene);
    assert_null(scene.sky_ring);
    assert_int_equal(scene.sky_sectors, 0);
    assert_int_equal(scene.margin, 0);
    assert_float_equal(scene.sky[2], 3, 0);
    dpl_scene_free(&scene);
}

static void a_ring_has_4096_sectors_at_most(void **state) {
    (void)state;
    enum { MOST = 4096 };
    static char text[64 + (MOST + 1) * 8];
    for (int count = MOST; count <= MOST + 1; count++) {
        dpl_scene scene;
        dpl_error error = {.text = ""};
        size_t used = (size_t)sprintf(text, "{\"dapple\":1,\"size\":[8,8],\"sky\":[");
        for (int k = 0; k < count; k++)
            used += (size_t)sprintf(text + used, "%s[0,1,0]", k ? "," : "");
        sprintf(text + used, "]}");
        bool good = dpl_scene_read_memory(text, strlen(text), "a.json", &scene, &error);
        assert_int_equal(good, count == MOST);
        assert_int_equal(scene.sky_sectors, count == MOST ? MOST : 0);
        if (!good)
            assert_string_equal(error.text, "a.json:1:32: sky: must have at most 4096 sectors (has 4097)");
        dpl_scene_free(&scene);
    }
}

static void images_are_found_beside_the_scene(void **state) {
    (void)state;
    static const uint8_t red[4][4] = {{255, 0, 0, 255}, {255, 0, 0, 0}, {0, 0, 0, 51}, {255, 255, 255, 255}};
    dpl_error error = {.text = ""};
    dpl_scene scene;
    assert_true(dpl_picture_write_png("scene-read-lamps.png", 2, 2, 4, &red[0][0], &error));
    const char *text =
        "{\"dapple\":1,\"size\":[8,8],\"images\":[{\"extinction\":\"scene-read-lamps.png\",\"emission\":"
        "\"scene-read-lamps.png\",\"at\":[-3,4],\"intensity\":2.5}]}";
    if (!dpl_scene_read_memory(text, strlen(text), "./a.json", &scene, &error))
        fail_msg("%s", error.text);
    assert_int_equal(scene.image_count, 1);
    const dpl_scene_image *image = scene.images;
    assert_string_equal(image->emission, "scene-read-lamps.png");
    assert_null(image->albedo);
    assert_null(image->albedo_picture.data);
    assert_int_equal(image->at[0], -3);
    assert_int_equal(image->at[1], 4);
    assert_float_equal(image->intensity, 2.5, 0);
    assert_int_equal(image->extinction_picture.channels, 4);
    assert_true(image->extinction_picture.display);
    assert_false(image->emission_picture.display);
    assert_float_equal(image->extinction_picture.data[11], 51 / 255.0f, 0);
    dpl_scene_free(&scene);
    remove("scene-read-lamps.png");
}

static void a_png_is_a_scene_of_one_image(void **state) {
    (void)state;
    static const uint8_t grey[6] = {0, 255, 0, 128, 0, 0};
    dpl_error error = {.text = ""};
    dpl_scene scene;
    assert_true(dpl_picture_write_png("./scene-read-walls.png", 3, 2, 1, grey, &error));
    if (!dpl_scene_read("./scene-read-walls.png", &scene, &error))
        fail_msg("%s", error.text);
    assert_int_equal(scene.width, 3);
    assert_int_equal(scene.height, 2);
    assert_int_equal(scene.image_count, 1);
    assert_string_equal(scene.images[0].emission, "scene-read-walls.png");
    assert_null(scene.images[0].extinction);
    assert_float_equal(scene.images[0].emission_picture.data[1], 1, 0);
    assert_float_equal(scene.images[0].intensity, 1, 0);
    dpl_scene_free(&scene);
    remove("scene-read-walls.png");
}

static void a_broken_png_is_refused(void **state) {
    (void)state;
    dpl_error error = {.text = ""};
    dpl_scene scene;
    assert_false(dpl_scene_read_memory("\x89PNG\r\n\x1a\n", 8, "b.png", &scene, &error));
    assert_int_equal(strncmp(error.text, "b.png: ", 7), 0);
    assert_null(scene.images);
}

static void a_hundred_thousand_shapes_are_read(void **state) {
    (void)state;
    static const char shape[] = "{\"disc\":{\"center\":[1,2],\"radius\":3}}";
    const size_t count = 100000;
    char *text = malloc(64 + count * (sizeof shape + 1));
    assert_non_null(text);
    size_t used = (size_t)sprintf(text, "{\"dapple\":1,\"size\":[8,8],\"shapes\":[");
    for (size_t i = 0; i < count; i++)
        used += (size_t)sprintf(text + used, "%s%s", i > 0 ? "," : "", shape);
    sprintf(text + used, "]}");
    dpl_scene scene;
    read_text(text, &scene);
    assert_int_equal(scene.shape_count, count);
    assert_float_equal(scene.shapes[count - 1].disc.radius, 3, 0);
    dpl_scene_free(&scene);
    free(text);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_key_arrives_where_it_belongs),
        cmocka_unit_test(lights_arrive_with_their_defaults),
        cmocka_unit_test(defaults_fill_what_is_left_out),
        cmocka_unit_test(a_sky_is_one_colour_or_a_ring),
        cmocka_unit_test(a_ring_has_4096_sectors_at_most),
        cmocka_unit_test(images_are_found_beside_the_scene),
        cmocka_unit_test(a_png_is_a_scene_of_one_image),
        cmocka_unit_test(a_broken_png_is_refused),
        cmocka_unit_test(a_hundred_thousand_shapes_are_read),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
