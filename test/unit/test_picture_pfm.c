/* PFM passes every bit both ways, in both byte orders, and its header cannot be lied with. */
#define _XOPEN_SOURCE 700 /* mkdtemp */

#include "testing.h"

#include "../../image/file.h"
#include "../../image/picture.h"
#include "test_file_folder.h"
#include "test_picture_channels.h"

#include <errno.h>
#include <locale.h>

/* Values whose bits a careless conversion would change: infinities, a negative zero, denormals, NaNs both
 * quiet and signalling. */
static const uint32_t odd_bits[] = {0x00000000, 0x80000000, 0x3f800000, 0x7f800000, 0xff800000, 0x7fc00000,
                                    0x7f800001, 0xffc12345, 0x00000001, 0x007fffff, 0x7f7fffff, 0x42280000};

static uint32_t bits_of(const float *value) {
    uint32_t bits;
    memcpy(&bits, value, sizeof bits);
    return bits;
}

/* Reads a header with data made of `data_size` zeros behind it. */
static bool read_text(const char *header, size_t data_size, dpl_picture *picture, dpl_error *error) {
    size_t size = strlen(header) + data_size;
    char *bytes = calloc(1, size + 1);
    assert_non_null(bytes);
    memcpy(bytes, header, strlen(header));
    bool good = dpl_picture_read_memory(bytes, size, "in.pfm", DPL_PICTURE_LINEAR, picture, error);
    free(bytes);
    return good;
}

static void every_bit_survives_writing_and_reading(void **state) {
    const char *path = folder_path(*state, "odd.pfm");
    dpl_picture picture, back;
    dpl_error error = {{0}};
    assert_true(dpl_picture_create(&picture, 2, 2, 3, &error));
    memcpy(picture.data, odd_bits, sizeof odd_bits);
    assert_true(dpl_picture_write(path, &picture, &error));
    assert_true(dpl_picture_read(path, DPL_PICTURE_LINEAR, &back, &error));
    assert_int_equal(back.width, 2);
    assert_int_equal(back.height, 2);
    assert_int_equal(back.channels, 3);
    assert_false(back.display);
    assert_memory_equal(back.data, odd_bits, sizeof odd_bits);
    dpl_picture_free(&picture);
    dpl_picture_free(&back);
}

static void the_file_is_little_endian_and_bottom_row_first(void **state) {
    const char *path = folder_path(*state, "rows.pfm");
    dpl_picture picture;
    assert_true(dpl_picture_create(&picture, 1, 2, 3, NULL));
    for (int i = 0; i < 6; i++)
        picture.data[i] = (float)i;
    assert_true(dpl_picture_write(path, &picture, NULL));
    static const char expected[] = "PF\n1 2\n-1.0\n"
                                   "\0\0\x40\x40\0\0\x80\x40\0\0\xa0\x40" /* 3 4 5: the lower row */
                                   "\0\0\0\0\0\0\x80\x3f\0\0\0\x40";      /* 0 1 2 */
    char *bytes;
    size_t size;
    assert_true(dpl_file_read(path, 1000, &bytes, &size, NULL));
    assert_int_equal(size, sizeof expected - 1);
    assert_memory_equal(bytes, expected, size);
    free(bytes);
    dpl_picture_free(&picture);
}

static void both_byte_orders_give_the_same_values(void **state) {
    (void)state;
    static const char little[] = "Pf\n1 2\n-1.0\n\0\0\x80\x3f\1\0\x80\x7f";
    static const char big[] = "Pf\r1\t2 +2.5e-3\n\x3f\x80\0\0\x7f\x80\0\1";
    const char *const files[] = {little, big};
    const size_t sizes[] = {sizeof little - 1, sizeof big - 1};
    for (int i = 0; i < 2; i++) {
        dpl_picture picture;
        assert_true(dpl_picture_read_memory(files[i], sizes[i], "in.pfm", DPL_PICTURE_RAW, &picture, NULL));
        assert_int_equal(picture.channels, 1);
        assert_false(picture.display); /* linear whatever was asked of PNG colours */
        assert_int_equal(bits_of(picture.data), 0x7f800001);
        assert_int_equal(bits_of(picture.data + 1), 0x3f800000);
        dpl_picture_free(&picture);
    }
}

static void every_number_of_channels_becomes_three(void **state) {
    assert_every_number_of_channels_becomes_three(folder_path(*state, "channels.pfm"));
}

static void headers_that_are_not_pfm_are_refused(void **state) {
    (void)state;
    static const char *const headers[] = {
        "PF",
        "PF\n",
        "PF\n1",
        "PF\n1 1",
        "PF\n1 1\n",
        "PF\n1 1\n-1.0",
        "PF1 1\n-1.0\n",
        "PF\n-1 1\n-1.0\n",
        "PF\n1 x\n-1\n",
        "PF\n1 1\nnan\n",
        "PF\n1 1\n0\n",
        "PF\n1 1\n-0.0\n",
        "PF\n1 1\n-\n",
        "PF\n1 1\n1e\n",
        "PF\n1 1\n1.0x\n",
        "PF\n1 1\n.\n",
        "PF\n1 1\n1,5\n",
        "PF\n1.5 1\n-1\n",
        "PF\n0x1 1\n-1\n",
        "PF\n1 1\ninf\n",
    };
    for (size_t i = 0; i < sizeof headers / sizeof *headers; i++) {
        dpl_picture picture;
        dpl_error error = {{0}};
        assert_false(read_text(headers[i], strlen(headers[i]) > 8 ? 12 : 0, &picture, &error));
        assert_null(picture.data);
        assert_string_equal(error.text, "in.pfm: broken PFM: the header is not 'PF WIDTH HEIGHT SCALE'");
    }
}

static void sizes_out_of_range_are_refused(void **state) {
    (void)state;
    static const char *const headers[] = {
        "PF\n0 1\n-1.0\n",
        "PF\n1 0\n-1.0\n",
        "PF\n16385 1\n-1.0\n",
        "Pf\n1 4294967297\n-1.0\n",
        "PF\n99999999999999999999999999 99999999999999999999999999\n-1.0\n",
    };
    for (size_t i = 0; i < sizeof headers / sizeof *headers; i++) {
        dpl_picture picture;
        dpl_error error = {{0}};
        assert_false(read_text(headers[i], 0, &picture, &error));
        assert_null(picture.data);
        assert_non_null(strstr(error.text, "pixels: 1 .. 16384 a side are possible"));
    }
}

static void data_of_another_size_is_refused(void **state) {
    (void)state;
    static const size_t sizes[] = {0, 1, 23, 25, 100};
    dpl_picture picture;
    dpl_error error = {{0}};
    for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++) {
        assert_false(read_text("PF\n2 1\n-1.0\n", sizes[i], &picture, &error));
        assert_null(picture.data);
    }
    assert_string_equal(error.text, "in.pfm: broken PFM: 2 x 1 pixels are 24 bytes, not 100");
    assert_false(
        read_text("PF\n16384 16384\n-1.0\n", 12, &picture, &error)); /* and quickly, if it is large */
    assert_true(read_text("PF\n2 1\n-1.0\n", 24, &picture, &error));
    dpl_picture_free(&picture);
}

static void the_locale_changes_nothing(void **state) {
    const char *path = folder_path(*state, "locale.pfm");
    static const char *const names[] = {"de_DE.UTF-8", "fr_FR.UTF-8", "C.UTF-8"};
    for (size_t i = 0; i < sizeof names / sizeof *names; i++)
        if (setlocale(LC_ALL, names[i]))
            break;
    dpl_picture picture, back;
    assert_true(dpl_picture_create(&picture, 2000, 1, 3, NULL));
    assert_true(dpl_picture_write(path, &picture, NULL));
    bool good = dpl_picture_read(path, DPL_PICTURE_LINEAR, &back, NULL);
    setlocale(LC_ALL, "C");
    assert_true(good);
    assert_int_equal(back.width, 2000);
    dpl_picture_free(&picture);
    dpl_picture_free(&back);
}

static void a_failed_write_leaves_the_old_picture(void **state) {
    test_folder *folder = *state;
    dpl_picture picture, back;
    dpl_error error = {{0}};
    assert_true(dpl_picture_create(&picture, 100, 100, 3, &error));
    assert_int_equal(symlink("/dev/full", folder_path(folder, "full.pfm")), 0);
    assert_false(dpl_picture_write(folder_path(folder, "full.pfm"), &picture, &error));
    assert_non_null(strstr(error.text, strerror(ENOSPC)));
    assert_int_equal(folder_count(folder), 1); /* the link alone */

    const char *path = folder_path(folder, "old.pfm");
    assert_true(dpl_picture_write(path, &picture, &error));
    picture.width = 0; /* broken by its owner */
    assert_false(dpl_picture_write(path, &picture, &error));
    picture.width = 100;
    assert_true(dpl_picture_read(path, DPL_PICTURE_LINEAR, &back, &error));
    assert_int_equal(back.width, 100);
    dpl_picture_free(&back);
    assert_false(dpl_picture_write(folder_path(folder, "nowhere/a.pfm"), &picture, &error));
    assert_non_null(strstr(error.text, "there is no folder"));
    dpl_picture_free(&picture);
}

static void a_dash_is_standard_output(void **state) {
    const char *path = folder_path(*state, "stdout.pfm");
    dpl_picture picture, back;
    assert_true(dpl_picture_create(&picture, 3, 1, 3, NULL));
    picture.data[4] = 7;
    fflush(stdout);
    int kept = dup(STDOUT_FILENO);
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    assert_true(dup2(fileno(file), STDOUT_FILENO) >= 0);
    bool good = dpl_picture_write("-", &picture, NULL);
    dup2(kept, STDOUT_FILENO);
    close(kept);
    fclose(file);
    assert_true(good);
    assert_true(dpl_picture_read(path, DPL_PICTURE_LINEAR, &back, NULL));
    assert_int_equal(back.width, 3);
    assert_true(back.data[4] == 7);
    dpl_picture_free(&picture);
    dpl_picture_free(&back);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        folder_test(every_bit_survives_writing_and_reading),
        folder_test(the_file_is_little_endian_and_bottom_row_first),
        cmocka_unit_test(both_byte_orders_give_the_same_values),
        folder_test(every_number_of_channels_becomes_three),
        cmocka_unit_test(headers_that_are_not_pfm_are_refused),
        cmocka_unit_test(sizes_out_of_range_are_refused),
        cmocka_unit_test(data_of_another_size_is_refused),
        folder_test(the_locale_changes_nothing),
        folder_test(a_failed_write_leaves_the_old_picture),
        folder_test(a_dash_is_standard_output),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
