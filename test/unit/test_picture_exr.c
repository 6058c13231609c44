/* EXR: what others write is read, what is written is read back bit for bit, and what is broken or not for us
 * is refused. The fixtures come from test/data/picture/make_pictures.py. */
#define _XOPEN_SOURCE 700 /* mkdtemp */

#include "testing.h"

#include "../../image/file.h"
#include "../../image/picture.h"
#include "test_file_folder.h"
#include "test_picture_channels.h"

#include <errno.h>

#define DATA DPL_TEST_DATA "/picture/"

static int skip_without_exr(void **state) {
    (void)state;
    if (!dpl_picture_has_exr())
        skip();
    return 0;
}

/* What make_pictures.py puts at a pixel. */
static float value(int channel, int x, int y) {
    return (float)channel * 100 + (float)y * 10 + (float)x + 0.5f;
}

static void assert_fixture(const char *path, int32_t width, int32_t height, int32_t channels,
                           const int *order) {
    dpl_picture picture;
    dpl_error error = {{0}};
    if (!dpl_picture_read(path, DPL_PICTURE_RAW, &picture, &error))
        fail_msg("%s", error.text);
    assert_int_equal(picture.width, width);
    assert_int_equal(picture.height, height);
    assert_int_equal(picture.channels, channels);
    assert_false(picture.display);
    const float *at = picture.data;
    for (int32_t y = 0; y < height; y++)
        for (int32_t x = 0; x < width; x++)
            for (int32_t k = 0; k < channels; k++)
                assert_true(*at++ == value(order[k], x, y));
    dpl_picture_free(&picture);
}

static void files_of_others_are_read(void **state) {
    skip_without_exr(state);
    static const int rgba[] = {0, 1, 2, 3}, ya[] = {4, 3};
    assert_fixture(DATA "rgb_half.exr", 5, 20, 3, rgba);
    assert_fixture(DATA "rgb_half_none.exr", 5, 3, 3, rgba);
    assert_fixture(DATA "rgba_float.exr", 4, 3, 4, rgba);
    assert_fixture(DATA "y_float.exr", 6, 4, 1, ya);
    assert_fixture(DATA "ya_half.exr", 3, 2, 2, ya);
    assert_fixture(DATA "rgb_window.exr", 3, 18, 3, rgba);
    assert_fixture(DATA "rgb_tiled.exr", 7, 5, 3, rgba);
    assert_fixture(DATA "rgba_tiled.exr", 5, 5, 4, rgba);
    assert_fixture(DATA "extra_channels.exr", 5, 3, 3, rgba);
}

static void what_is_broken_or_not_for_us_is_refused(void **state) {
    skip_without_exr(state);
    static const char *const cases[][2] = {
        {DATA "bad_uint.exr", "an EXR with channels that are neither half nor float"},
        {DATA "bad_sampling.exr", "an EXR with subsampled channels"},
        {DATA "bad_layer.exr", "an EXR without channels R, G, B or Y"},
        {DATA "bad_b44.exr", "an EXR with B44 or DWA compression"},
        {DATA "bad_block.exr", "broken EXR: a block of pixels has the wrong size"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        dpl_picture picture;
        dpl_error error = {{0}};
        char text[sizeof error.text];
        snprintf(text, sizeof text, "%s: %s", cases[i][0], cases[i][1]);
        assert_false(dpl_picture_read(cases[i][0], DPL_PICTURE_LINEAR, &picture, &error));
        assert_null(picture.data);
        assert_string_equal(error.text, text);
    }
}

/* Every length of a cut file is an error of one line, and nothing appears on standard error. */
static void a_file_cut_anywhere_is_refused(void **state) {
    test_folder *folder = *state;
    skip_without_exr(state);
    const char *heard = folder_path(folder, "stderr");
    fflush(stderr);
    int kept = dup(STDERR_FILENO);
    FILE *file = fopen(heard, "wb");
    assert_non_null(file);
    dup2(fileno(file), STDERR_FILENO);
    char *bytes;
    size_t size;
    bool all = dpl_file_read(DATA "rgba_tiled.exr", 10000, &bytes, &size, NULL);
    for (size_t cut = 4; all && cut < size; cut++) {
        dpl_picture picture;
        dpl_error error = {{0}};
        all = !dpl_picture_read_memory(bytes, cut, "cut.exr", DPL_PICTURE_LINEAR, &picture, &error) &&
              !picture.data && strncmp(error.text, "cut.exr: ", 9) == 0 && !strchr(error.text, '\n');
    }
    free(bytes);
    dup2(kept, STDERR_FILENO);
    close(kept);
    fclose(file);
    assert_true(all);
    assert_true(dpl_file_read(heard, 10000, &bytes, &size, NULL));
    assert_string_equal(bytes, "");
    free(bytes);
}

/* Bytes changed one at a time: whatever comes of it, no crash, and an error or a whole picture. */
static void a_file_damaged_anywhere_does_no_harm(void **state) {
    skip_without_exr(state);
    char *bytes;
    size_t size, refused = 0;
    assert_true(dpl_file_read(DATA "rgb_half.exr", 10000, &bytes, &size, NULL));
    for (size_t at = 4; at < size; at++) {
        dpl_picture picture;
        dpl_error error = {{0}};
        bytes[at] = (char)(bytes[at] ^ 0xff);
        bool good = dpl_picture_read_memory(bytes, size, "damaged.exr", DPL_PICTURE_LINEAR, &picture, &error);
        assert_int_equal(good, picture.data != NULL);
        assert_int_equal(good, error.text[0] == 0);
        refused += !good;
        dpl_picture_free(&picture);
        bytes[at] = (char)(bytes[at] ^ 0xff);
    }
    assert_true(refused > size / 4); /* deflate's checksum alone sees to that */
    free(bytes);
}

static void every_bit_survives_writing_and_reading(void **state) {
    test_folder *folder = *state;
    skip_without_exr(state);
    static const uint32_t odd_bits[] = {0x80000000, 0x7f800000, 0xff800000, 0x7fc00000,
                                        0x7f800001, 0xffc12345, 0x00000001, 0x7f7fffff};
    static const int32_t sizes[][2] = {{1, 1}, {3, 40}, {257, 33}};
    for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++) {
        dpl_picture picture, back;
        dpl_error error = {{0}};
        assert_true(dpl_picture_create(&picture, sizes[i][0], sizes[i][1], 3, &error));
        size_t count = (size_t)sizes[i][0] * (size_t)sizes[i][1] * 3;
        for (size_t k = 0; k < count; k++)
            if (k % 5 == 0)
                memcpy(picture.data + k, &odd_bits[k / 5 % 8], sizeof *odd_bits);
            else
                picture.data[k] = (float)k * 0.37f;
        const char *path = folder_path(folder, "odd.EXR");
        assert_true(dpl_picture_write(path, &picture, &error));
        assert_true(dpl_picture_read(path, DPL_PICTURE_LINEAR, &back, &error));
        assert_int_equal(back.width, picture.width);
        assert_int_equal(back.height, picture.height);
        assert_int_equal(back.channels, 3);
        assert_memory_equal(back.data, picture.data, count * sizeof *back.data);
        dpl_picture_free(&picture);
        dpl_picture_free(&back);
    }
    assert_int_equal(folder_count(folder), 1);
}

static void every_number_of_channels_becomes_three(void **state) {
    skip_without_exr(state);
    assert_every_number_of_channels_becomes_three(folder_path(*state, "channels.exr"));
}

static void a_failed_write_says_why_and_leaves_nothing(void **state) {
    test_folder *folder = *state;
    skip_without_exr(state);
    dpl_picture picture;
    dpl_error error = {{0}};
    assert_true(dpl_picture_create(&picture, 4, 4, 3, &error));
    assert_int_equal(symlink("/dev/full", folder_path(folder, "full.exr")), 0);
    assert_false(dpl_picture_write(folder_path(folder, "full.exr"), &picture, &error));
    assert_non_null(strstr(error.text, strerror(ENOSPC)));
    assert_false(dpl_picture_write(folder_path(folder, "nowhere/a.exr"), &picture, &error));
    assert_non_null(strstr(error.text, "there is no folder"));
    assert_int_equal(folder_count(folder), 1); /* the link alone */
    dpl_picture_free(&picture);
}

static void a_build_without_exr_says_so(void **state) {
    test_folder *folder = *state;
    if (dpl_picture_has_exr())
        skip();
    dpl_picture picture;
    dpl_error error = {{0}};
    assert_false(dpl_picture_read(DATA "rgb_half.exr", DPL_PICTURE_LINEAR, &picture, &error));
    assert_non_null(strstr(error.text, "rgb_half.exr: this build reads no EXR"));
    assert_true(dpl_picture_create(&picture, 1, 1, 3, &error));
    assert_false(dpl_picture_write(folder_path(folder, "a.exr"), &picture, &error));
    assert_non_null(strstr(error.text, "a.exr: this build writes no EXR"));
    assert_int_equal(folder_count(folder), 0);
    dpl_picture_free(&picture);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(files_of_others_are_read),
        cmocka_unit_test(what_is_broken_or_not_for_us_is_refused),
        folder_test(a_file_cut_anywhere_is_refused),
        cmocka_unit_test(a_file_damaged_anywhere_does_no_harm),
        folder_test(every_bit_survives_writing_and_reading),
        folder_test(every_number_of_channels_becomes_three),
        folder_test(a_failed_write_says_why_and_leaves_nothing),
        folder_test(a_build_without_exr_says_so),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
