/* PFM, the portable float map: a text header, then raw floats, bottom row first. Values pass bit for bit.
 * Called through the tables in picture_file.c.
 *
 * Format: P. Debevec's description, "PF" (RGB) or "Pf" (grey), width, height, and a scale whose sign is the
 * byte order (negative: little endian). What the scale's size means is not agreed upon, so values are taken
 * as they are stored. */
#include "file.h"
#include "formats.h"

#include <errno.h>
#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

typedef struct pfm_header {
    int64_t width;
    int64_t height;
    int32_t channels;
    bool big_endian;
    size_t size; /* of the header: where the floats start [byte] */
} pfm_header;

/* ---- The header, read without the C library's help, which listens to the locale ------------------- */

/* A byte of the file, or 0 behind its end; 0 ends every token. */
static unsigned char byte_at(const dpl_picture_source *source, size_t at) {
    return at < source->size ? source->bytes[at] : 0;
}

static bool is_space(unsigned char byte) {
    return byte == ' ' || (byte >= '\t' && byte <= '\r');
}

static bool is_digit(unsigned char byte) {
    return byte >= '0' && byte <= '9';
}

/* Skips at least one space. */
static bool skip_space(const dpl_picture_source *source, size_t *at) {
    size_t start = *at;
    while (is_space(byte_at(source, *at)))
        (*at)++;
    return *at > start;
}

/* Skips digits; returns whether one of them is not zero. */
static bool skip_digits(const dpl_picture_source *source, size_t *at) {
    bool any = false;
    for (; is_digit(byte_at(source, *at)); (*at)++)
        any = any || byte_at(source, *at) != '0';
    return any;
}

/* A whole number; what is too large for any picture stays too large without overflow. */
static bool read_size(const dpl_picture_source *source, size_t *at, int64_t *value) {
    size_t start = *at;
    for (*value = 0; is_digit(byte_at(source, *at)); (*at)++)
        if (*value < INT32_MAX)
            *value = *value * 10 + (byte_at(source, *at) - '0');
    return *at > start;
}

/* A decimal number that is not zero, of which only the sign counts. */
static bool read_scale(const dpl_picture_source *source, size_t *at, bool *negative) {
    *negative = byte_at(source, *at) == '-';
    if (*negative || byte_at(source, *at) == '+')
        (*at)++;
    bool any = skip_digits(source, at);
    if (byte_at(source, *at) == '.') {
        (*at)++;
        any = skip_digits(source, at) || any;
    }
    if (byte_at(source, *at) == 'e' || byte_at(source, *at) == 'E') {
        (*at)++;
        if (byte_at(source, *at) == '-' || byte_at(source, *at) == '+')
            (*at)++;
        if (!is_digit(byte_at(source, *at)))
            return false;
        skip_digits(source, at);
    }
    return any;
}

static bool read_header(const dpl_picture_source *source, pfm_header *header) {
    size_t at = 2;
    bool negative;
    header->channels = byte_at(source, 1) == 'F' ? 3 : 1;
    if (!skip_space(source, &at) || !read_size(source, &at, &header->width) || !skip_space(source, &at) ||
        !read_size(source, &at, &header->height) || !skip_space(source, &at) ||
        !read_scale(source, &at, &negative) || !is_space(byte_at(source, at)))
        return false;
    header->big_endian = !negative;
    header->size = at + 1; /* exactly one space: the next byte may be a float's */
    return true;
}

/* ---- Reading -------------------------------------------------------------------------------------- */

static void convert_row(const unsigned char *bytes, bool big_endian, size_t count, float *row) {
    for (size_t i = 0; i < count; i++, bytes += 4) {
        uint32_t bits =
            big_endian
                ? (uint32_t)bytes[0] << 24 | (uint32_t)bytes[1] << 16 | (uint32_t)bytes[2] << 8 | bytes[3]
                : (uint32_t)bytes[3] << 24 | (uint32_t)bytes[2] << 16 | (uint32_t)bytes[1] << 8 | bytes[0];
        memcpy(row + i, &bits, sizeof bits);
    }
}

/* Does the data match the header? Judged before memory is asked for. */
static bool check_size(const dpl_picture_source *source, const pfm_header *header, dpl_error *error) {
    if (header->width > DPL_PICTURE_MAX_SIZE || header->height > DPL_PICTURE_MAX_SIZE)
        return true; /* refused with the text that all formats share */
    uint64_t wanted = (uint64_t)header->width * (uint64_t)header->height * (uint64_t)header->channels * 4;
    uint64_t found = source->size - header->size;
    if (wanted == found)
        return true;
    return dpl_error_set(
        error, "%s: broken PFM: %" PRId64 " x %" PRId64 " pixels are %" PRIu64 " bytes, not %" PRIu64,
        source->name, header->width, header->height, wanted, found);
}

bool dpl_pfm_read(const dpl_picture_source *source, dpl_picture *picture, dpl_error *error) {
    pfm_header header;
    if (!read_header(source, &header))
        return dpl_picture_broken(source, "PFM", "the header is not 'PF WIDTH HEIGHT SCALE'", error);
    if (!check_size(source, &header, error) ||
        !dpl_picture_create_read(source, header.width, header.height, header.channels, picture, error))
        return false;
    size_t count = (size_t)header.width * (size_t)header.channels;
    const unsigned char *bytes = source->bytes + header.size;
    for (size_t y = (size_t)header.height; y-- > 0; bytes += 4 * count)
        convert_row(bytes, header.big_endian, count, picture->data + y * count);
    return true;
}

/* ---- Writing -------------------------------------------------------------------------------------- */

static void pack_row(const float *row, size_t count, unsigned char *bytes) {
    for (size_t i = 0; i < count; i++) {
        uint32_t bits;
        memcpy(&bits, row + i, sizeof bits);
        for (int k = 0; k < 4; k++)
            *bytes++ = (unsigned char)(bits >> (8 * k) & 255);
    }
}

static bool write_rows(FILE *stream, const dpl_picture *picture, float *rgb, unsigned char *bytes) {
    size_t count = (size_t)picture->width * 3;
    if (fprintf(stream, "PF\n%" PRId32 " %" PRId32 "\n-1.0\n", picture->width, picture->height) < 0)
        return false;
    for (int32_t y = picture->height - 1; y >= 0; y--) {
        dpl_picture_rgb_row(picture, y, rgb);
        pack_row(rgb, count, bytes);
        if (fwrite(bytes, 4, count, stream) != count)
            return false;
    }
    return true;
}

bool dpl_pfm_write(const char *path, const dpl_picture *picture, dpl_error *error) {
    size_t count = (size_t)picture->width * 3;
    float *rgb = malloc(count * sizeof *rgb);
    unsigned char *bytes = malloc(count * 4);
    dpl_file_writer writer;
    bool good = false;
    if (!rgb || !bytes) {
        dpl_error_set(error, "%s: out of memory", path);
    } else if (dpl_file_writer_open(&writer, path, error)) {
        errno = 0;
        good = write_rows(writer.stream, picture, rgb, bytes);
        if (!good)
            dpl_error_set(error, "%s: %s", path, strerror(errno ? errno : EIO));
        good = dpl_file_writer_close(&writer, good, error);
    }
    free(rgb);
    free(bytes);
    return good;
}
