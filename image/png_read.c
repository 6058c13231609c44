/* Reads PNG with libpng: every bit depth and colour type, exactly. Called through the table in
 * picture_file.c. */
#include "formats.h"
#include "srgb.h"

#include <png.h>
#include <setjmp.h>
#include <stdlib.h>
#include <string.h>

/* No deflate stream unpacks to more than this many times its size: two bits make at most 258 bytes. */
#define DEFLATE_RATIO 1032

/* Lives outside the function that calls setjmp, so that a jump finds everything as it was. */
typedef struct png_reader {
    const dpl_picture_source *source;
    size_t offset; /* of the next byte to hand to libpng */
    dpl_picture *picture;
    dpl_error *error;
    png_structp png;
    png_infop info;
    unsigned char *rows; /* one row as libpng unpacks it, or all of an interlaced picture */
    float *colours;      /* value of each stored colour sample; 0 = not computed yet, or zero */
    bool error_set;      /* the error says all: libpng's text is not needed */
    char text[160];      /* what libpng said */
} png_reader;

/* ---- What libpng calls ---------------------------------------------------------------------------- */

static void on_error(png_structp png, png_const_charp text) {
    png_reader *reader = png_get_error_ptr(png);
    strncpy(reader->text, text, sizeof reader->text - 1);
    png_longjmp(png, 1);
}

/* Warnings are about things that do not change the pixels. */
static void on_warning(png_structp png, png_const_charp text) {
    (void)png;
    (void)text;
}

static void on_read(png_structp png, png_bytep bytes, size_t size) {
    png_reader *reader = png_get_io_ptr(png);
    if (size > reader->source->size - reader->offset)
        png_error(png, "the file is cut short");
    memcpy(bytes, reader->source->bytes + reader->offset, size);
    reader->offset += size;
}

/* ---- Samples to floats ---------------------------------------------------------------------------- */

static float alpha_value(unsigned value, unsigned maximum) {
    return (float)((double)value / maximum);
}

static float colour_value(png_reader *reader, unsigned value, unsigned maximum) {
    float *colour = &reader->colours[value];
    if (*colour == 0) { /* filled in as values turn up: few pictures use all of 65536 */
        double encoded = (double)value / maximum;
        *colour = (float)(reader->source->colour == DPL_PICTURE_LINEAR ? dpl_picture_srgb_decode(encoded)
                                                                       : encoded);
    }
    return *colour;
}

static void convert_row(png_reader *reader, const unsigned char *row, int32_t y, unsigned maximum) {
    const dpl_picture *picture = reader->picture;
    size_t channels = (size_t)picture->channels, samples = (size_t)picture->width * channels;
    size_t alpha = channels % 2 == 0 ? channels - 1 : SIZE_MAX;
    float *out = picture->data + (size_t)y * samples;
    for (size_t i = 0; i < samples; i++) {
        unsigned value = maximum > 255 ? (unsigned)row[2 * i] << 8 | row[2 * i + 1] : row[i];
        out[i] = i % channels == alpha ? alpha_value(value, maximum) : colour_value(reader, value, maximum);
    }
}

/* ---- The file ------------------------------------------------------------------------------------- */

/* Sets everything up and makes the picture. Libpng's own allocations that depend on the size come later. */
static bool read_header(png_reader *reader) {
    png_structp png = reader->png;
    const dpl_picture_source *source = reader->source;
    /* Sizes are judged below, with one text for all formats. Of the chunks that are not needed for pixels
     * none is unpacked, but all must be sound. */
    png_set_user_limits(png, PNG_UINT_31_MAX, PNG_UINT_31_MAX);
    png_set_keep_unknown_chunks(png, PNG_HANDLE_CHUNK_NEVER, NULL, -1);
    png_set_crc_action(png, PNG_CRC_ERROR_QUIT, PNG_CRC_ERROR_QUIT);
    png_read_info(png, reader->info);

    png_uint_32 width = png_get_image_width(png, reader->info);
    png_uint_32 height = png_get_image_height(png, reader->info);
    bool small = width <= DPL_PICTURE_MAX_SIZE && height <= DPL_PICTURE_MAX_SIZE;
    uint64_t stored = (uint64_t)png_get_rowbytes(png, reader->info) * height;
    if (small && stored / DEFLATE_RATIO > source->size) {
        reader->error_set = true;
        return dpl_error_set(reader->error, "%s: broken PNG: %zu bytes cannot hold %u x %u pixels",
                             source->name, source->size, (unsigned)width, (unsigned)height);
    }
    int channels = png_get_channels(png, reader->info);
    if (png_get_color_type(png, reader->info) == PNG_COLOR_TYPE_PALETTE)
        channels = 3;
    channels += png_get_valid(png, reader->info, PNG_INFO_tRNS) != 0;
    reader->error_set = true; /* by this one, if at all */
    if (!dpl_picture_create_read(source, width, height, channels, reader->picture, reader->error))
        return false;
    reader->error_set = false;
    return true;
}

static bool allocate(png_reader *reader, size_t row_size, size_t row_count, size_t maximum) {
    reader->rows = row_count > SIZE_MAX / row_size ? NULL : malloc(row_size * row_count);
    reader->colours = calloc(maximum + 1, sizeof *reader->colours);
    if (reader->rows && reader->colours)
        return true;
    reader->error_set = true;
    return dpl_error_set(reader->error, "%s: out of memory", reader->source->name);
}

static bool read_pixels(png_reader *reader) {
    png_structp png = reader->png;
    png_set_expand(png); /* palette to RGB, 1, 2 and 4 bit to 8, tRNS to alpha */
    int pass_count = png_set_interlace_handling(png);
    png_read_update_info(png, reader->info);
    if (png_get_channels(png, reader->info) != reader->picture->channels)
        png_error(png, "unexpected channels");

    size_t row_size = png_get_rowbytes(png, reader->info);
    size_t row_count = pass_count > 1 ? (size_t)reader->picture->height : 1;
    unsigned maximum = png_get_bit_depth(png, reader->info) == 16 ? 65535 : 255;
    if (!allocate(reader, row_size, row_count, maximum))
        return false;
    for (int pass = 0; pass < pass_count; pass++)
        for (int32_t y = 0; y < reader->picture->height; y++) {
            unsigned char *row = reader->rows + (pass_count > 1 ? (size_t)y * row_size : 0);
            png_read_row(png, row, NULL);
            if (pass == pass_count - 1)
                convert_row(reader, row, y, maximum);
        }
    png_read_end(png, NULL);
    return true;
}

/* The only function that is jumped back to. */
static bool read_all(png_reader *reader) {
    if (setjmp(png_jmpbuf(reader->png)))
        return false;
    return read_header(reader) && read_pixels(reader);
}

bool dpl_png_read(const dpl_picture_source *source, dpl_picture *picture, dpl_error *error) {
    png_reader reader = {.source = source, .picture = picture, .error = error};
    reader.png = png_create_read_struct(PNG_LIBPNG_VER_STRING, &reader, on_error, on_warning);
    if (reader.png)
        reader.info = png_create_info_struct(reader.png);
    bool good = false;
    if (reader.info) {
        png_set_read_fn(reader.png, &reader, on_read);
        good = read_all(&reader);
        if (!good && !reader.error_set)
            dpl_picture_broken(source, "PNG", reader.text, error);
    } else {
        dpl_error_set(error, "%s: libpng does not start", source->name);
    }
    png_destroy_read_struct(&reader.png, &reader.info, NULL);
    free(reader.rows);
    free(reader.colours);
    if (good)
        picture->display = source->colour == DPL_PICTURE_RAW;
    else
        dpl_picture_free(picture);
    return good;
}
