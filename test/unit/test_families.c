/* Families are complete, seeded, the paper's where they say so, and survive being written. */
#include "scene_same.h"

#include "../../scenes/families.h"
#include "../../scenes/random.h"
#include "../../scenes/scene_builder.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void make(const dpl_scene_family *family, uint64_t seed, int32_t index, int32_t size,
                 dpl_scene *scene) {
    dpl_error error = {.text = ""};
    assert_non_null(family);
    if (!family->make(seed, index, size, scene, &error))
        fail_msg("%s-%02d: %s", family->name, index, error.text);
}

static void the_table_is_complete(void **state) {
    (void)state;
    static const struct {
        const char *name;
        int32_t count;
    } expected[] = {{"arc", 50},    {"demo", 1},       {"pictures", 1}, {"maze", 10},    {"rooms", 10},
                    {"thin", 10},   {"tiny", 10},      {"area", 10},    {"clutter", 10}, {"fog", 10},
                    {"bounce", 10}, {"offscreen", 10}, {"shadows", 12}};
    int32_t count;
    const dpl_scene_family *families = dpl_scene_families(&count);
    assert_int_equal(count, sizeof expected / sizeof expected[0]);
    for (int32_t i = 0; i < count; i++) {
        assert_string_equal(families[i].name, expected[i].name);
        assert_int_equal(families[i].count, expected[i].count);
        assert_true(strlen(families[i].summary) > 0);
        assert_ptr_equal(dpl_scene_family_find(expected[i].name), &families[i]);
    }
    assert_null(dpl_scene_family_find("Arc"));
    assert_null(dpl_scene_family_find(""));
}

static void arc_has_the_papers_configurations(void **state) {
    (void)state;
    static const int32_t expected[50][2] = {
        {1, 1},  {1, 3},  {2, 1},  {2, 3},  {3, 1},  {3, 3},  {4, 1},  {4, 3},  {5, 1},  {5, 3},
        {6, 2},  {6, 5},  {6, 8},  {7, 2},  {7, 5},  {7, 8},  {8, 2},  {8, 5},  {8, 8},  {10, 2},
        {10, 5}, {10, 8}, {12, 2}, {12, 5}, {12, 8}, {15, 2}, {15, 5}, {15, 8}, {18, 3}, {18, 5},
        {18, 8}, {20, 3}, {20, 5}, {20, 8}, {25, 3}, {25, 5}, {25, 8}, {30, 3}, {30, 5}, {30, 8},
        {35, 3}, {35, 5}, {35, 8}, {40, 3}, {40, 5}, {40, 8}, {45, 3}, {45, 5}, {45, 8}, {50, 3}};
    for (int32_t i = 0; i < 50; i++) {
        int32_t lights, occluders;
        dpl_scene_arc_configuration(i, &lights, &occluders);
        assert_int_equal(lights, expected[i][0]);
        assert_int_equal(occluders, expected[i][1]);
    }
}

static void arc_has_no_scene_outside_its_fifty(void **state) {
    (void)state;
    dpl_scene scene;
    dpl_error error = {.text = ""};
    int32_t lights, occluders;
    dpl_scene_arc_configuration(-1, &lights, &occluders);
    assert_int_equal(lights + occluders, 0);
    dpl_scene_arc_configuration(100, &lights, &occluders);
    assert_int_equal(lights + occluders, 0);
    assert_false(dpl_scene_family_find("arc")->make(1, -1, 64, &scene, &error));
    assert_string_equal(error.text, "arc: there are scenes 0 to 49, but no -1");
    assert_null(scene.shapes);
}

static void shadows_has_one_light_per_scene_in_two_sizes(void **state) {
    (void)state;
    dpl_scene scene;
    dpl_error error = {.text = ""};
    for (int32_t i = 0; i < 12; i++) {
        make(dpl_scene_family_find("shadows"), 1, i, 256, &scene);
        assert_int_equal(scene.light_count, 1);
        if (i < 8)
            assert_true(scene.lights[0].radius == (i % 2 ? 9 : 3));
        dpl_scene_free(&scene);
    }
    assert_false(dpl_scene_family_find("shadows")->make(1, 12, 64, &scene, &error));
    assert_string_equal(error.text, "shadows: there are scenes 0 to 11, but no 12");
    assert_false(dpl_scene_family_find("shadows")->make(1, 3, 0, &scene, &error));
}

static void assert_between(double value, double low, double high) {
    if (!(value >= low && value < high))
        fail_msg("%g is not in [%g, %g)", value, low, high);
}

static void check_arc_shape(const dpl_shape *shape, bool light) {
    if (!light) {
        assert_int_equal(shape->kind, DPL_SHAPE_BOX);
        assert_between(shape->box.center[0], 50, 462);
        assert_between(shape->box.center[1], 50, 462);
        assert_between(shape->box.half[0], 5, 35);
        assert_between(shape->box.half[1], 5, 65);
        return;
    }
    const float *emission = shape->material.emission;
    float most = fmaxf(emission[0], fmaxf(emission[1], emission[2]));
    float least = fminf(emission[0], fminf(emission[1], emission[2]));
    assert_int_equal(shape->kind, DPL_SHAPE_DISC);
    assert_between(shape->disc.center[0], 30, 482);
    assert_between(shape->disc.center[1], 30, 482);
    assert_between(shape->disc.radius, 3, 18);
    /* lightness (most + least) / 2 from 0.5 to 0.8, times an intensity from 0.5 to 2 */
    assert_between((double)(most + least) / 2, 0.25, 1.6);
    assert_true(isinf(shape->material.extinction[0]));
}

static void arc_draws_stay_in_the_papers_ranges(void **state) {
    (void)state;
    const dpl_scene_family *arc = dpl_scene_family_find("arc");
    for (int32_t i = 0; i < 50; i++) {
        dpl_scene scene;
        int32_t lights, occluders;
        dpl_scene_arc_configuration(i, &lights, &occluders);
        make(arc, 42, i, 512, &scene);
        assert_int_equal(scene.shape_count, lights + occluders);
        assert_float_equal(scene.sky[0], 0.02, 0);
        assert_float_equal(scene.sky[1], 0.03, 0);
        assert_float_equal(scene.sky[2], 0.05, 0);
        for (int32_t k = 0; k < scene.shape_count; k++)
            check_arc_shape(&scene.shapes[k], k >= occluders);
        dpl_scene_free(&scene);
    }
}

static void arc_scales_with_the_size(void **state) {
    (void)state;
    dpl_scene base, half;
    make(dpl_scene_family_find("arc"), 3, 1, 512, &base);
    make(dpl_scene_family_find("arc"), 3, 1, 256, &half);
    assert_int_equal(half.width, 256);
    assert_int_equal(half.height, 256);
    assert_float_equal(half.shapes[0].box.half[1], base.shapes[0].box.half[1] / 2, 0);
    assert_float_equal(half.shapes[3].disc.radius, base.shapes[3].disc.radius / 2, 0);
    dpl_scene_free(&base);
    dpl_scene_free(&half);
}

static void the_generator_is_the_published_one(void **state) {
    (void)state;
    /* First outputs of xoshiro256** from the state 1, 2, 3, 4. */
    dpl_random random = {{1, 2, 3, 4}};
    assert_true(dpl_random_bits(&random) == 11520u);
    assert_true(dpl_random_bits(&random) == 0u);
    assert_true(dpl_random_bits(&random) == 1509978240u);
    assert_true(dpl_random_bits(&random) == 1215971899390074240u);
    double sum = 0;
    for (int i = 0; i < 10000; i++) {
        double unit = dpl_random_unit(&random);
        assert_between(unit, 0, 1);
        assert_between(dpl_random_below(&random, 7), 0, 7);
        sum += unit;
    }
    assert_between(sum / 10000, 0.49, 0.51);
}

static void seeds_give_pinned_scenes(void **state) {
    (void)state;
    dpl_scene scene;
    make(dpl_scene_family_find("arc"), 1, 0, 512, &scene);
    assert_float_equal(scene.shapes[0].box.center[0], 102.26374067941055, 0);
    assert_float_equal(scene.shapes[1].disc.radius, 16.552849833426578, 0);
    assert_float_equal(scene.shapes[1].material.emission[0], 0.114890993f, 0);
    dpl_scene_free(&scene);
    make(dpl_scene_family_find("fog"), 1, 9, 512, &scene);
    assert_int_equal(scene.shape_count, 10);
    assert_float_equal(scene.shapes[0].material.extinction[0], 0.0173736699f, 0);
    dpl_scene_free(&scene);
}

static bool differ(const dpl_scene *a, const dpl_scene *b) {
    return a->shape_count != b->shape_count ||
           memcmp(a->shapes, b->shapes, (size_t)a->shape_count * sizeof *a->shapes) != 0;
}

static void scenes_depend_on_seed_and_index_alone(void **state) {
    (void)state;
    int32_t count;
    const dpl_scene_family *families = dpl_scene_families(&count);
    for (int32_t i = 0; i < count; i++) {
        dpl_scene first, again, other_seed, other_index;
        if (families[i].count == 1)
            continue; /* made by hand */
        make(&families[i], 5, 3, 128, &first);
        make(&families[i], 6, 3, 128, &other_seed);
        make(&families[i], 5, 4, 128, &other_index);
        make(&families[i], 5, 3, 128, &again);
        assert_same_scene(&first, &again);
        assert_true(differ(&first, &other_seed));
        assert_true(differ(&first, &other_index));
        dpl_scene_free(&first);
        dpl_scene_free(&again);
        dpl_scene_free(&other_seed);
        dpl_scene_free(&other_index);
    }
}

static void every_family_survives_being_written(void **state) {
    (void)state;
    int32_t count;
    const dpl_scene_family *families = dpl_scene_families(&count);
    for (int32_t i = 0; i < count; i++) {
        dpl_error error = {.text = ""};
        if (!dpl_scene_family_write(&families[i], 9, 96, "families-written", &error))
            fail_msg("%s", error.text);
        for (int32_t k = 0; k < families[i].count; k++) {
            char path[128];
            dpl_scene made, read;
            snprintf(path, sizeof path, "families-written/%s-%02d.json", families[i].name, k);
            make(&families[i], 9, k, 96, &made);
            if (!dpl_scene_read(path, &read, &error))
                fail_msg("%s", error.text);
            assert_same_scene(&made, &read);
            assert_int_equal(read.width, 96);
            dpl_scene_free(&made);
            dpl_scene_free(&read);
            remove(path);
        }
    }
    remove("families-written/pictures-lamps.png");
    remove("families-written/pictures-walls.png");
    remove("families-written/pictures-paint.png");
    assert_int_equal(remove("families-written"), 0); /* nothing else was left there */
}

static void odd_sizes_are_made_and_bad_ones_refused(void **state) {
    (void)state;
    static const int32_t good[] = {1, 7, 61, 2048}, bad[] = {0, -5, 16385, INT32_MAX};
    int32_t count;
    const dpl_scene_family *families = dpl_scene_families(&count);
    for (int32_t i = 0; i < count; i++) {
        dpl_scene scene;
        for (size_t k = 0; k < sizeof good / sizeof good[0]; k++) {
            make(&families[i], 1, 0, good[k], &scene);
            assert_int_equal(scene.width, good[k]);
            assert_true(scene.shape_count + scene.image_count > 0);
            dpl_scene_free(&scene);
        }
        for (size_t k = 0; k < sizeof bad / sizeof bad[0]; k++) {
            dpl_error error = {.text = ""};
            assert_false(families[i].make(1, 0, bad[k], &scene, &error));
            assert_true(strlen(error.text) > 0);
            assert_null(scene.shapes);
            assert_null(scene.images);
        }
    }
}

static void the_demo_has_all_four_kinds_and_media(void **state) {
    (void)state;
    dpl_scene scene;
    int32_t kinds[4] = {0}, media = 0, lamps = 0;
    make(dpl_scene_family_find("demo"), 0, 0, 512, &scene);
    for (int32_t i = 0; i < scene.shape_count; i++) {
        const dpl_material *material = &scene.shapes[i].material;
        kinds[scene.shapes[i].kind]++;
        media += isfinite(material->extinction[0]) != 0;
        lamps += isinf(material->extinction[0]) && material->emission[0] > 0;
    }
    for (int k = 0; k < 4; k++)
        assert_true(kinds[k] > 0);
    assert_true(media >= 5 && lamps >= 5);
    dpl_scene_free(&scene);
}

static void bounce_paints_between_two_and_nine_tenths(void **state) {
    (void)state;
    for (int32_t i = 0; i < 10; i++) {
        dpl_scene scene;
        int32_t painted = 0, coloured = 0, lamps = 0;
        make(dpl_scene_family_find("bounce"), 4, i, 256, &scene);
        for (int32_t k = 0; k < scene.shape_count; k++) {
            const dpl_material *m = &scene.shapes[k].material;
            float most = fmaxf(m->albedo[0], fmaxf(m->albedo[1], m->albedo[2]));
            assert_true(isinf(m->extinction[0]));
            lamps += m->emission[0] > 0;
            painted += most > 0;
            coloured += m->albedo[0] < 0.9f * most || m->albedo[2] < 0.9f * most;
            if (!(m->emission[0] > 0))
                assert_between((double)most, 0.2, 0.9);
        }
        assert_true(lamps >= 1 && painted >= 8 && coloured >= 2);
        assert_int_equal(lamps + painted, scene.shape_count);
        dpl_scene_free(&scene);
    }
}

static void offscreen_lamps_stand_in_the_margin(void **state) {
    (void)state;
    static const int32_t sizes[] = {256, 512, 16383};
    for (int32_t i = 0; i < 30; i++) {
        dpl_scene scene;
        int32_t size = sizes[i % 3], lamps = 0;
        make(dpl_scene_family_find("offscreen"), 4, i / 3, size, &scene);
        assert_int_equal(scene.margin, size == 16383 ? 0 : size / 4);
        assert_int_equal(scene.sky_sectors, 12);
        for (int32_t k = 0; k < scene.shape_count; k++) {
            const dpl_shape *shape = &scene.shapes[k];
            if (shape->kind != DPL_SHAPE_DISC)
                continue;
            double x = shape->disc.center[0], y = shape->disc.center[1], r = shape->disc.radius;
            bool outside = x + r <= 0 || y + r <= 0 || x - r >= size || y - r >= size;
            double reach = fmax(fmax(-x, x - size), fmax(-y, y - size)) + r;
            assert_true(outside && reach <= size / 4.0);
            lamps++;
        }
        assert_true(lamps >= 2);
        dpl_scene_free(&scene);
    }
}

static void an_unwritable_folder_is_an_error(void **state) {
    (void)state;
    dpl_error error = {.text = ""};
    assert_false(dpl_scene_family_write(dpl_scene_family_find("arc"), 1, 64, "no/such/folder", &error));
    assert_string_equal(error.text, "no/such/folder: No such file or directory");
}

static void hues_become_colours(void **state) {
    (void)state;
    static const double expected[6][3] = {{1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 1, 1}, {0, 0, 1}, {1, 0, 1}};
    double rgb[3];
    for (int i = 0; i < 6; i++) {
        dpl_colour_from_hsl(i / 6.0, 1, 0.5, rgb);
        for (int k = 0; k < 3; k++)
            assert_float_equal(rgb[k], expected[i][k], 1e-12);
    }
    dpl_colour_from_hsl(0.3, 0, 0.7, rgb);
    for (int k = 0; k < 3; k++)
        assert_float_equal(rgb[k], 0.7, 1e-12);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_table_is_complete),
        cmocka_unit_test(arc_has_the_papers_configurations),
        cmocka_unit_test(arc_has_no_scene_outside_its_fifty),
        cmocka_unit_test(shadows_has_one_light_per_scene_in_two_sizes),
        cmocka_unit_test(arc_draws_stay_in_the_papers_ranges),
        cmocka_unit_test(arc_scales_with_the_size),
        cmocka_unit_test(the_generator_is_the_published_one),
        cmocka_unit_test(seeds_give_pinned_scenes),
        cmocka_unit_test(scenes_depend_on_seed_and_index_alone),
        cmocka_unit_test(every_family_survives_being_written),
        cmocka_unit_test(odd_sizes_are_made_and_bad_ones_refused),
        cmocka_unit_test(the_demo_has_all_four_kinds_and_media),
        cmocka_unit_test(bounce_paints_between_two_and_nine_tenths),
        cmocka_unit_test(offscreen_lamps_stand_in_the_margin),
        cmocka_unit_test(an_unwritable_folder_is_an_error),
        cmocka_unit_test(hues_become_colours),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
