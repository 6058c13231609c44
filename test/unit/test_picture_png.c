/* PNG: every bit depth and colour type is read exactly, what lies or is cut short is refused with one clear
 * line, and what is written reads back. */
#define _XOPEN_SOURCE 700 /* mkdtemp */

#include "testing.h"

#include "../../image/file.h"
#include "../../image/picture.h"
#include "test_file_folder.h"
#include "test_picture_png.h"

#include <errno.h>
#include <math.h>

/* ---- Helpers -------------------------------------------------------------------------------------- */

/* The sRGB curve as in IEC 61966-2-1. */
static float linear(unsigned value, unsigned maximum) {
    double encoded = (double)value / maximum;
    return (float)(encoded <= 0.04045 ? encoded / 12.92 : pow((encoded + 0.055) / 1.055, 2.4));
}

static float raw(unsigned value, unsigned maximum) {
    return (float)((double)value / maximum);
}

static int file_setup(void **state) {
    *state = calloc(1, sizeof(png_file));
    return *state ? 0 : -1;
}

static int file_teardown(void **state) {
    free(*state);
    return 0;
}

static dpl_picture read_good(const png_file *file, dpl_picture_colour colour) {
    dpl_picture picture;
    dpl_error error = {{0}};
    if (!dpl_picture_read_memory(file->bytes, file->size, "in.png", colour, &picture, &error))
        fail_msg("%s", error.text);
    assert_int_equal(picture.display, colour == DPL_PICTURE_RAW);
    return picture;
}

/* Refused with exactly this text, or any that begins so. */
static void assert_refused(const unsigned char *bytes, size_t size, const char *text) {
    dpl_picture picture;
    dpl_error error = {{0}};
    assert_false(dpl_picture_read_memory(bytes, size, "in.png", DPL_PICTURE_LINEAR, &picture, &error));
    assert_null(picture.data);
    assert_null(strchr(error.text, '\n'));
    if (strncmp(error.text, text, strlen(text)) != 0)
        assert_string_equal(error.text, text);
}

/* Some value of any depth; masked by who asks. */
static unsigned scramble(int x, int y, int k) {
    return (unsigned)(x * 7919 + y * 104729 + k * 1299709 + 77) * 2654435761u >> 8;
}

static unsigned sample1(int x, int y, int k) {
    return scramble(x, y, k) & 1;
}
static unsigned sample2(int x, int y, int k) {
    return scramble(x, y, k) & 3;
}
static unsigned sample4(int x, int y, int k) {
    return scramble(x, y, k) & 15;
}
static unsigned sample8(int x, int y, int k) {
    return scramble(x, y, k) & 255;
}
static unsigned sample16(int x, int y, int k) {
    return scramble(x, y, k) & 65535;
}

static png_sample *sample_of(int depth) {
    return depth == 1   ? sample1
           : depth == 2 ? sample2
           : depth == 4 ? sample4
           : depth == 8 ? sample8
                        : sample16;
}

/* ---- What is read --------------------------------------------------------------------------------- */

static void check_kind(png_file *file, const png_kind *kind, dpl_picture_colour colour) {
    png_sample *sample = sample_of(kind->depth);
    int channels = png_channels(kind->colour);
    unsigned maximum = (1u << kind->depth) - 1;
    png_begin(file, kind);
    png_end(file, kind, sample);
    dpl_picture picture = read_good(file, colour);
    assert_int_equal(picture.width, kind->width);
    assert_int_equal(picture.height, kind->height);
    assert_int_equal(picture.channels, channels);
    const float *at = picture.data;
    for (int y = 0; y < kind->height; y++)
        for (int x = 0; x < kind->width; x++)
            for (int k = 0; k < channels; k++) {
                bool decode = colour == DPL_PICTURE_LINEAR && (channels % 2 || k < channels - 1);
                unsigned value = sample(x, y, k);
                assert_true(*at++ == (decode ? linear(value, maximum) : raw(value, maximum)));
            }
    dpl_picture_free(&picture);
}

static void every_depth_and_colour_type_is_read_exactly(void **state) {
    static const int kinds[][2] = {{1, PNG_GREY},      {2, PNG_GREY},       {4, PNG_GREY},
                                   {8, PNG_GREY},      {16, PNG_GREY},      {8, PNG_RGB},
                                   {16, PNG_RGB},      {8, PNG_GREY_ALPHA}, {16, PNG_GREY_ALPHA},
                                   {8, PNG_RGB_ALPHA}, {16, PNG_RGB_ALPHA}};
    static const int sizes[][2] = {{1, 1}, {13, 9}, {3, 17}};
    for (size_t i = 0; i < sizeof kinds / sizeof *kinds; i++)
        for (size_t s = 0; s < sizeof sizes / sizeof *sizes; s++)
            for (int interlaced = 0; interlaced < 2; interlaced++)
                for (int colour = DPL_PICTURE_LINEAR; colour <= DPL_PICTURE_RAW; colour++) {
                    png_kind kind = {sizes[s][0], sizes[s][1], kinds[i][0], kinds[i][1], interlaced};
                    check_kind(*state, &kind, (dpl_picture_colour)colour);
                }
}

static void a_palette_becomes_colours(void **state) {
    static const unsigned char palette[] = {1, 2, 3, 255, 128, 0, 7, 8, 9, 200, 100, 50};
    for (int depth = 2; depth <= 8; depth *= 2)
        for (int interlaced = 0; interlaced < 2; interlaced++) {
            png_file *file = *state;
            png_kind kind = {11, 5, depth, PNG_INDEXED, interlaced};
            png_begin(file, &kind);
            png_chunk(file, "PLTE", palette, sizeof palette);
            png_end(file, &kind, sample2);
            dpl_picture picture = read_good(file, DPL_PICTURE_LINEAR);
            assert_int_equal(picture.channels, 3);
            for (int i = 0; i < 11 * 5 * 3; i++) {
                unsigned index = sample2(i / 3 % 11, i / 33, 0);
                assert_true(picture.data[i] == linear(palette[3 * index + (unsigned)i % 3], 255));
            }
            dpl_picture_free(&picture);
        }
}

static void transparent_palette_entries_become_alpha(void **state) {
    static const unsigned char palette[] = {10, 20, 30, 40, 50, 60, 70, 80, 90}, alpha[] = {0, 128};
    png_file *file = *state;
    png_kind kind = {3, 1, 8, PNG_INDEXED, false};
    png_begin(file, &kind);
    png_chunk(file, "PLTE", palette, sizeof palette);
    png_chunk(file, "tRNS", alpha, sizeof alpha);
    png_rows rows = {.bytes = {0, 0, 1, 2}, .size = 4};
    png_data(file, rows.bytes, rows.size);
    png_chunk(file, "IEND", "", 0);
    dpl_picture picture = read_good(file, DPL_PICTURE_RAW);
    assert_int_equal(picture.channels, 4);
    for (unsigned i = 0; i < 9; i++)
        assert_true(picture.data[i / 3 * 4 + i % 3] == raw(palette[i], 255));
    assert_true(picture.data[3] == 0);
    assert_true(picture.data[7] == raw(128, 255));
    assert_true(picture.data[11] == 1);
    dpl_picture_free(&picture);
}

static void a_transparent_colour_becomes_alpha(void **state) {
    for (int depth = 8; depth <= 16; depth *= 2) {
        png_file *file = *state;
        png_kind kind = {2, 1, depth, PNG_RGB, false};
        png_sample *sample = sample_of(depth);
        unsigned char key[6];
        for (int k = 0; k < 3; k++) {
            key[2 * k] = (unsigned char)(sample(1, 0, k) >> 8);
            key[2 * k + 1] = (unsigned char)sample(1, 0, k);
        }
        png_begin(file, &kind);
        png_chunk(file, "tRNS", key, sizeof key);
        png_end(file, &kind, sample);
        dpl_picture picture = read_good(file, DPL_PICTURE_LINEAR);
        assert_int_equal(picture.channels, 4);
        assert_true(picture.data[3] == 1);
        assert_true(picture.data[7] == 0);
        assert_true(picture.data[4] == linear(sample(1, 0, 0), (1u << depth) - 1)); /* colour is kept */
        dpl_picture_free(&picture);
    }
}

static void a_transparent_grey_of_few_bits_becomes_alpha(void **state) {
    static const unsigned char key[] = {0, 1};
    png_file *file = *state;
    png_kind kind = {9, 1, 2, PNG_GREY, false};
    png_begin(file, &kind);
    png_chunk(file, "tRNS", key, sizeof key);
    png_end(file, &kind, sample2);
    dpl_picture picture = read_good(file, DPL_PICTURE_RAW);
    assert_int_equal(picture.channels, 2);
    for (int x = 0; x < 9; x++) {
        assert_true(picture.data[2 * x] == raw(sample2(x, 0, 0), 3));
        assert_true(picture.data[2 * x + 1] == (sample2(x, 0, 0) == 1 ? 0.0f : 1.0f));
    }
    dpl_picture_free(&picture);
}

static void gamma_and_text_change_nothing(void **state) {
    static const unsigned char gamma[] = {0, 1, 0x86, 0xa0}; /* 1.0 */
    png_file *file = *state;
    png_kind kind = {2, 2, 8, PNG_RGB, false};
    png_begin(file, &kind);
    png_chunk(file, "gAMA", gamma, sizeof gamma);
    png_chunk(file, "tEXt", "Comment\0hello", 13);
    png_chunk(file, "iCCP", "nonsense", 8);
    png_end(file, &kind, sample8);
    dpl_picture picture = read_good(file, DPL_PICTURE_LINEAR);
    assert_true(picture.data[0] == linear(sample8(0, 0, 0), 255));
    dpl_picture_free(&picture);
}

/* ---- What is refused ------------------------------------------------------------------------------ */

static void a_file_cut_anywhere_is_refused(void **state) {
    png_file *file = *state;
    png_kind kind = {5, 4, 8, PNG_RGB_ALPHA, false};
    png_begin(file, &kind);
    png_end(file, &kind, sample8);
    for (size_t size = 8; size < file->size; size++)
        assert_refused(file->bytes, size, "in.png: broken PNG: ");
    assert_refused(file->bytes, file->size - 20, "in.png: broken PNG: the file is cut short");
}

/* Every chunk is under a checksum, so one changed byte is noticed wherever it is. */
static void a_byte_changed_anywhere_is_noticed(void **state) {
    png_file *file = *state;
    png_kind kind = {3, 3, 8, PNG_RGB, true};
    png_begin(file, &kind);
    png_chunk(file, "tEXt", "Comment\0hello", 13);
    png_end(file, &kind, sample8);
    for (size_t at = 0; at < file->size; at++) {
        file->bytes[at] ^= 0x10;
        assert_refused(file->bytes, file->size, "in.png: ");
        file->bytes[at] ^= 0x10;
    }
    file->bytes[file->size - 13] ^= 1; /* the last of IDAT's own checksum */
    assert_refused(file->bytes, file->size, "in.png: broken PNG: IDAT: CRC error");
}

static void a_size_over_the_limit_is_refused(void **state) {
    static const int sizes[][2] = {
        {DPL_PICTURE_MAX_SIZE + 1, 1}, {1, DPL_PICTURE_MAX_SIZE + 1}, {INT32_MAX, INT32_MAX}};
    for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++) {
        png_file *file = *state;
        png_kind kind = {sizes[i][0], sizes[i][1], 16, PNG_RGB_ALPHA, i % 2};
        char text[100];
        snprintf(text, sizeof text, "in.png: %d x %d pixels: 1 .. 16384 a side are possible", kind.width,
                 kind.height);
        png_begin(file, &kind);
        png_data(file, (const unsigned char *)"", 0);
        png_chunk(file, "IEND", "", 0);
        assert_refused(file->bytes, file->size, text);
    }
}

static void a_size_that_the_data_cannot_have_is_refused(void **state) {
    png_file *file = *state;
    png_kind kind = {DPL_PICTURE_MAX_SIZE, DPL_PICTURE_MAX_SIZE, 16, PNG_RGB_ALPHA, false};
    png_begin(file, &kind);
    png_data(file, (const unsigned char *)"", 0);
    png_chunk(file, "IEND", "", 0);
    char text[100];
    snprintf(text, sizeof text, "in.png: broken PNG: %zu bytes cannot hold 16384 x 16384 pixels", file->size);
    assert_refused(file->bytes, file->size, text);
}

static void a_size_larger_than_the_data_is_refused(void **state) {
    for (int interlaced = 0; interlaced < 2; interlaced++) {
        png_file *file = *state;
        png_kind kind = {8, 8, 8, PNG_GREY, interlaced}, lie = {8, 9, 8, PNG_GREY, interlaced};
        png_begin(file, &lie);
        png_end(file, &kind, sample8);
        /* Passes take their rows from one stream, so an interlaced one is out of step before it is short. */
        assert_refused(file->bytes, file->size,
                       interlaced ? "in.png: broken PNG: " : "in.png: broken PNG: Not enough image data");
    }
}

static void a_size_of_nothing_is_refused(void **state) {
    png_file *file = *state;
    png_kind kind = {0, 5, 8, PNG_GREY, false};
    png_begin(file, &kind);
    png_data(file, (const unsigned char *)"", 0);
    png_chunk(file, "IEND", "", 0);
    assert_refused(file->bytes, file->size, "in.png: ");
}

static void a_palette_picture_without_palette_is_refused(void **state) {
    png_file *file = *state;
    png_kind kind = {2, 2, 8, PNG_INDEXED, false};
    png_begin(file, &kind);
    png_end(file, &kind, sample1);
    assert_refused(file->bytes, file->size, "in.png: broken PNG: IDAT: ");
}

static void impossible_depths_are_refused(void **state) {
    static const int kinds[][2] = {{3, PNG_GREY}, {4, PNG_RGB}, {16, PNG_INDEXED}, {8, 5}, {0, PNG_GREY}};
    for (size_t i = 0; i < sizeof kinds / sizeof *kinds; i++) {
        png_file *file = *state;
        png_kind kind = {2, 2, kinds[i][0], kinds[i][1], false};
        png_begin(file, &kind);
        png_data(file, (const unsigned char *)"", 0);
        png_chunk(file, "IEND", "", 0);
        assert_refused(file->bytes, file->size, "in.png: broken PNG: ");
    }
}

static void libpng_is_silent(void **state) {
    void *own = NULL;
    assert_int_equal(folder_setup(&own), 0);
    test_folder *folder = own;
    const char *path = folder_path(folder, "stderr");
    fflush(stderr);
    int kept = dup(STDERR_FILENO);
    FILE *stream = fopen(path, "wb");
    assert_non_null(stream);
    dup2(fileno(stream), STDERR_FILENO);
    a_file_cut_anywhere_is_refused(state);
    gamma_and_text_change_nothing(state);
    dup2(kept, STDERR_FILENO);
    close(kept);
    fclose(stream);
    char *heard;
    size_t size;
    assert_true(dpl_file_read(path, 10000, &heard, &size, NULL));
    assert_string_equal(heard, "");
    free(heard);
    assert_int_equal(folder_teardown(&own), 0);
}

/* ---- What is written ------------------------------------------------------------------------------ */

static void what_is_written_is_read_back(void **state) {
    test_folder *folder = *state;
    const char *path = folder_path(folder, "out.png");
    uint8_t data[7 * 5 * 4];
    for (size_t i = 0; i < sizeof data; i++)
        data[i] = (uint8_t)(i * 31);
    for (int32_t channels = 1; channels <= 4; channels += channels == 1 ? 2 : 1) {
        dpl_picture picture;
        dpl_error error = {{0}};
        assert_true(dpl_picture_write_png(path, 7, 5, channels, data, &error));
        assert_true(dpl_picture_read(path, DPL_PICTURE_RAW, &picture, &error));
        assert_int_equal(picture.width, 7);
        assert_int_equal(picture.height, 5);
        assert_int_equal(picture.channels, channels);
        for (int i = 0; i < 7 * 5 * channels; i++)
            assert_true(picture.data[i] == raw(data[i], 255));
        dpl_picture_free(&picture);
    }
    assert_int_equal(folder_count(folder), 1);
}

static void the_written_file_says_srgb(void **state) {
    const char *path = folder_path(*state, "out.png");
    static const uint8_t pixel[3] = {1, 2, 3};
    char *bytes;
    size_t size, at = 0;
    assert_true(dpl_picture_write_png(path, 1, 1, 3, pixel, NULL));
    assert_true(dpl_file_read(path, 10000, &bytes, &size, NULL));
    while (at + 4 < size && memcmp(bytes + at, "sRGB", 4) != 0)
        at++;
    assert_true(at + 4 < size);
    free(bytes);
}

static void a_failed_write_says_why_and_leaves_the_old_picture(void **state) {
    test_folder *folder = *state;
    static const uint8_t pixels[2] = {1, 2};
    dpl_error error = {{0}};
    assert_false(dpl_picture_write_png("/dev/full", 2, 1, 1, pixels, &error));
    assert_string_equal(error.text + strlen("/dev/full: "), strerror(ENOSPC));
    assert_false(dpl_picture_write_png(folder_path(folder, "nowhere/a.png"), 2, 1, 1, pixels, &error));
    assert_non_null(strstr(error.text, "there is no folder"));

    const char *path = folder_path(folder, "a.png");
    assert_true(dpl_picture_write_png(path, 2, 1, 1, pixels, &error));
    static const int32_t bad[][3] = {{0, 1, 1}, {1, 0, 1}, {1, 1, 2}, {1, 1, 0}, {1, 1, 5}, {-1, 1, 1}};
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++)
        assert_false(dpl_picture_write_png(path, bad[i][0], bad[i][1], bad[i][2], pixels, &error));
    assert_false(dpl_picture_write_png(path, 2000000, 1, 1, pixels, &error)); /* libpng says no */
    dpl_picture picture;
    assert_true(dpl_picture_read(path, DPL_PICTURE_RAW, &picture, &error));
    assert_int_equal(picture.width, 2);
    dpl_picture_free(&picture);
    assert_int_equal(folder_count(folder), 1);
}

#define file_test(function) cmocka_unit_test_setup_teardown(function, file_setup, file_teardown)

int main(void) {
    const struct CMUnitTest tests[] = {
        file_test(every_depth_and_colour_type_is_read_exactly),
        file_test(a_palette_becomes_colours),
        file_test(transparent_palette_entries_become_alpha),
        file_test(a_transparent_colour_becomes_alpha),
        file_test(a_transparent_grey_of_few_bits_becomes_alpha),
        file_test(gamma_and_text_change_nothing),
        file_test(a_file_cut_anywhere_is_refused),
        file_test(a_byte_changed_anywhere_is_noticed),
        file_test(a_size_over_the_limit_is_refused),
        file_test(a_size_that_the_data_cannot_have_is_refused),
        file_test(a_size_larger_than_the_data_is_refused),
        file_test(a_size_of_nothing_is_refused),
        file_test(a_palette_picture_without_palette_is_refused),
        file_test(impossible_depths_are_refused),
        file_test(libpng_is_silent),
        folder_test(what_is_written_is_read_back),
        folder_test(the_written_file_says_srgb),
        folder_test(a_failed_write_says_why_and_leaves_the_old_picture),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
