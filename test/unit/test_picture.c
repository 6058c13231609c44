/* Pictures in memory, and the choice of a format by content or by name. */
#define _XOPEN_SOURCE 700 /* mkdtemp */

#include "testing.h"

#include "../../image/picture.h"
#include "test_file_folder.h"

static void a_new_picture_is_all_zeros(void **state) {
    (void)state;
    dpl_picture picture;
    dpl_error error = {{0}};
    assert_true(dpl_picture_create(&picture, 5, 3, 2, &error));
    assert_int_equal(picture.width, 5);
    assert_int_equal(picture.height, 3);
    assert_int_equal(picture.channels, 2);
    assert_false(picture.display);
    for (int i = 0; i < 5 * 3 * 2; i++)
        assert_true(picture.data[i] == 0);
    dpl_picture_free(&picture);
    assert_null(picture.data);
    assert_int_equal(picture.width, 0);
    dpl_picture_free(&picture); /* freeing a zeroed picture is fine */
}

static void impossible_sizes_are_refused(void **state) {
    (void)state;
    static const int32_t sizes[][3] = {{0, 1, 1},
                                       {1, 0, 1},
                                       {-1, 1, 1},
                                       {1, INT32_MIN, 1},
                                       {1, 1, 0},
                                       {1, 1, 5},
                                       {1, 1, -1},
                                       {DPL_PICTURE_MAX_SIZE + 1, 1, 1},
                                       {1, DPL_PICTURE_MAX_SIZE + 1, 1},
                                       {INT32_MAX, INT32_MAX, 4}};
    for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++) {
        dpl_picture picture;
        dpl_error error = {{0}};
        assert_false(dpl_picture_create(&picture, sizes[i][0], sizes[i][1], sizes[i][2], &error));
        assert_null(picture.data);
        assert_int_not_equal(strlen(error.text), 0);
    }
    dpl_picture picture;
    assert_false(dpl_picture_create(&picture, 0, 0, 0, NULL)); /* nobody need ask why */
}

static void the_largest_width_and_height_are_possible(void **state) {
    (void)state;
    dpl_picture picture;
    assert_true(dpl_picture_create(&picture, DPL_PICTURE_MAX_SIZE, 1, 4, NULL));
    dpl_picture_free(&picture);
    assert_true(dpl_picture_create(&picture, 1, DPL_PICTURE_MAX_SIZE, 1, NULL));
    dpl_picture_free(&picture);
}

static void views_show_the_picture_as_it_is(void **state) {
    (void)state;
    dpl_picture picture;
    assert_true(dpl_picture_create(&picture, 4, 2, 3, NULL));
    dpl_pixels pixels = dpl_picture_pixels(&picture);
    assert_ptr_equal(pixels.data, picture.data);
    assert_int_equal(pixels.format, DPL_FORMAT_F32);
    assert_int_equal(pixels.width, 4);
    assert_int_equal(pixels.height, 2);
    assert_int_equal(pixels.channels, 3);
    assert_int_equal(pixels.row_stride, 0);
    dpl_output output = dpl_picture_output(&picture);
    assert_ptr_equal(output.data, picture.data);
    assert_int_equal(output.width, 4);
    assert_int_equal(output.height, 2);
    assert_int_equal(output.channels, 3);
    assert_int_equal(output.row_stride, 0);
    dpl_picture_free(&picture);
}

static void what_is_no_picture_is_refused_by_name(void **state) {
    (void)state;
    static const char *const contents[] = {"", "P", "P6\n1 1\n255\nabc", "\x89PNG", "GIF89a", "\x76\x2f\x31"};
    for (size_t i = 0; i < sizeof contents / sizeof *contents; i++) {
        dpl_picture picture;
        dpl_error error = {{0}};
        assert_false(dpl_picture_read_memory(contents[i], strlen(contents[i]), "some.png", DPL_PICTURE_LINEAR,
                                             &picture, &error));
        assert_null(picture.data);
        assert_string_equal(error.text, "some.png: not a picture that can be read (PNG, PFM or EXR)");
    }
    dpl_picture picture;
    dpl_error error = {{0}};
    assert_false(dpl_picture_read("nowhere.png", DPL_PICTURE_RAW, &picture, &error));
    assert_null(picture.data);
    assert_int_equal(strncmp(error.text, "nowhere.png: ", 13), 0);
}

static void the_content_not_the_name_says_the_format(void **state) {
    const char *path = folder_path(*state, "really_a_png.pfm");
    static const uint8_t grey[] = {0, 255};
    dpl_error error = {{0}};
    assert_true(dpl_picture_write_png(path, 2, 1, 1, grey, &error));
    dpl_picture picture;
    assert_true(dpl_picture_read(path, DPL_PICTURE_RAW, &picture, &error));
    assert_int_equal(picture.width, 2);
    assert_true(picture.display);
    dpl_picture_free(&picture);
}

static void names_that_can_be_written_are_known(void **state) {
    (void)state;
    static const char *const good[] = {"a.png", "a.PNG", "out/b.Pfm", "a.exr.pfm", "-", ".png"};
    static const char *const bad[] = {"", "a", "png", "a.jpg", "a.png/", "a.png ", "--", "a.pfmx"};
    dpl_error error = {{0}};
    for (size_t i = 0; i < sizeof good / sizeof *good; i++)
        assert_true(dpl_picture_can_write(good[i], &error));
    assert_string_equal(error.text, "");
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++)
        assert_false(dpl_picture_can_write(bad[i], &error));
    assert_string_equal(error.text, "a.pfmx: the name must end in .png, .pfm or .exr");
    error.text[0] = 0;
    assert_int_equal(dpl_picture_can_write("a.EXR", &error), dpl_picture_has_exr());
    if (!dpl_picture_has_exr())
        assert_string_equal(error.text, "a.EXR: this build writes no EXR; use .pfm or .png");
}

static void linear_values_do_not_go_into_a_png(void **state) {
    test_folder *folder = *state;
    dpl_picture picture;
    dpl_error error = {{0}};
    assert_true(dpl_picture_create(&picture, 1, 1, 3, &error));
    assert_false(dpl_picture_write(folder_path(folder, "a.png"), &picture, &error));
    assert_non_null(strstr(error.text, "a.png: linear values go into .pfm or .exr"));
    dpl_picture_free(&picture);
    assert_false(dpl_picture_write(folder_path(folder, "a.pfm"), &picture, &error)); /* there is none now */
    assert_int_equal(folder_count(folder), 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_new_picture_is_all_zeros),
        cmocka_unit_test(impossible_sizes_are_refused),
        cmocka_unit_test(the_largest_width_and_height_are_possible),
        cmocka_unit_test(views_show_the_picture_as_it_is),
        cmocka_unit_test(what_is_no_picture_is_refused_by_name),
        folder_test(the_content_not_the_name_says_the_format),
        cmocka_unit_test(names_that_can_be_written_are_known),
        folder_test(linear_values_do_not_go_into_a_png),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
