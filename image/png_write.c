/* Writes 8-bit PNG with libpng. Called by the tools, for pictures to look at. */
#include "buffer.h"
#include "file.h"
#include "picture.h"

#include <png.h>
#include <setjmp.h>
#include <string.h>

typedef struct png_writer {
    dpl_byte_buffer buffer; /* the file as it comes to be */
    png_structp png;
    png_infop info;
    char text[160]; /* what went wrong */
} png_writer;

/* By the number of channels. */
static const int colour_types[] = {-1, PNG_COLOR_TYPE_GRAY, -1, PNG_COLOR_TYPE_RGB, PNG_COLOR_TYPE_RGB_ALPHA};

static void on_error(png_structp png, png_const_charp text) {
    png_writer *writer = png_get_error_ptr(png);
    strncpy(writer->text, text, sizeof writer->text - 1);
    png_longjmp(png, 1);
}

static void on_warning(png_structp png, png_const_charp text) {
    (void)png;
    (void)text;
}

static void on_write(png_structp png, png_bytep bytes, size_t size) {
    png_writer *writer = png_get_io_ptr(png);
    if (!dpl_byte_buffer_put(&writer->buffer, writer->buffer.size, bytes, size))
        png_error(png, "out of memory");
}

static void on_flush(png_structp png) {
    (void)png;
}

/* The only function that is jumped back to. */
static bool encode(png_writer *writer, int32_t width, int32_t height, int32_t channels, const uint8_t *data) {
    if (setjmp(png_jmpbuf(writer->png)))
        return false;
    png_structp png = writer->png;
    png_set_write_fn(png, writer, on_write, on_flush);
    png_set_IHDR(png, writer->info, (png_uint_32)width, (png_uint_32)height, 8, colour_types[channels],
                 PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    png_set_sRGB(png, writer->info, PNG_sRGB_INTENT_PERCEPTUAL);
    png_write_info(png, writer->info);
    for (int32_t y = 0; y < height; y++)
        png_write_row(png, data + (size_t)y * (size_t)width * (size_t)channels);
    png_write_end(png, NULL);
    return true;
}

bool dpl_picture_write_png(const char *path, int32_t width, int32_t height, int32_t channels,
                           const uint8_t *data, dpl_error *error) {
    if (!data || width < 1 || height < 1 || channels < 1 || channels > 4 || colour_types[channels] < 0)
        return dpl_error_set(error, "%s: there is no picture to write", path);
    png_writer writer = {0};
    writer.png = png_create_write_struct(PNG_LIBPNG_VER_STRING, &writer, on_error, on_warning);
    if (writer.png)
        writer.info = png_create_info_struct(writer.png);
    bool good = writer.info && encode(&writer, width, height, channels, data);
    if (good)
        good = dpl_file_write(path, writer.buffer.bytes, writer.buffer.size, error);
    else
        dpl_error_set(error, "%s: %s", path, writer.text[0] ? writer.text : "libpng does not start");
    png_destroy_write_struct(&writer.png, &writer.info);
    dpl_byte_buffer_free(&writer.buffer);
    return good;
}
