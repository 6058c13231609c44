/* A PNG encoder that can lie: chunks by hand, stored deflate blocks, samples of any depth, interlaced or not.
 * Independent of libpng, so that the reader is checked against the format rather than against itself. */
#ifndef DPL_TEST_PICTURE_PNG_H
#define DPL_TEST_PICTURE_PNG_H

#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

#define PNG_CAPACITY (1 << 18)

enum { PNG_GREY = 0, PNG_RGB = 2, PNG_INDEXED = 3, PNG_GREY_ALPHA = 4, PNG_RGB_ALPHA = 6 };

/* The stored sample k of pixel (x, y). */
typedef unsigned png_sample(int x, int y, int k);

typedef struct png_file {
    unsigned char bytes[PNG_CAPACITY];
    size_t size;
    size_t chunk; /* where the chunk being written starts */
} png_file;

typedef struct png_kind {
    int width, height;
    int depth;  /* bits per sample */
    int colour; /* type, as in IHDR */
    bool interlaced;
} png_kind;

static inline int png_channels(int colour) {
    return colour == PNG_RGB ? 3 : colour == PNG_GREY_ALPHA ? 2 : colour == PNG_RGB_ALPHA ? 4 : 1;
}

/* ---- Bytes and chunks ----------------------------------------------------------------------------- */

static inline void png_put(png_file *file, unsigned value) {
    assert_true(file->size < PNG_CAPACITY);
    file->bytes[file->size++] = (unsigned char)value;
}

static inline void png_put32(png_file *file, uint32_t value) {
    for (int shift = 24; shift >= 0; shift -= 8)
        png_put(file, value >> shift & 255);
}

static inline uint32_t png_crc(const unsigned char *bytes, size_t size) {
    uint32_t crc = 0xffffffff;
    for (size_t i = 0; i < size; i++) {
        crc ^= bytes[i];
        for (int k = 0; k < 8; k++)
            crc = crc >> 1 ^ (crc & 1 ? 0xedb88320 : 0);
    }
    return ~crc;
}

static inline void png_start(png_file *file, const char *name) {
    file->chunk = file->size;
    png_put32(file, 0);
    for (int i = 0; i < 4; i++)
        png_put(file, (unsigned char)name[i]);
}

static inline void png_finish(png_file *file) {
    size_t end = file->size;
    file->size = file->chunk;
    png_put32(file, (uint32_t)(end - file->chunk - 8));
    file->size = end;
    png_put32(file, png_crc(file->bytes + file->chunk + 4, end - file->chunk - 4));
}

static inline void png_chunk(png_file *file, const char *name, const void *data, size_t size) {
    png_start(file, name);
    for (size_t i = 0; i < size; i++)
        png_put(file, ((const unsigned char *)data)[i]);
    png_finish(file);
}

/* Signature and IHDR. */
static inline void png_begin(png_file *file, const png_kind *kind) {
    static const unsigned char signature[] = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};
    memcpy(file->bytes, signature, sizeof signature);
    file->size = sizeof signature;
    png_start(file, "IHDR");
    png_put32(file, (uint32_t)kind->width);
    png_put32(file, (uint32_t)kind->height);
    png_put(file, (unsigned)kind->depth);
    png_put(file, (unsigned)kind->colour);
    png_put(file, 0);
    png_put(file, 0);
    png_put(file, kind->interlaced);
    png_finish(file);
}

/* ---- Pixels --------------------------------------------------------------------------------------- */

typedef struct png_rows {
    unsigned char bytes[PNG_CAPACITY];
    size_t size;
} png_rows;

/* One row of every `step`-th pixel from `first`, unfiltered, packed high bits first. */
static inline void png_row(png_rows *rows, const png_kind *kind, png_sample *sample, int y, int first,
                           int step) {
    unsigned pending = 0;
    int pending_bits = 0;
    rows->bytes[rows->size++] = 0;
    for (int x = first; x < kind->width; x += step)
        for (int k = 0; k < png_channels(kind->colour); k++) {
            unsigned value = sample(x, y, k);
            if (kind->depth == 16)
                rows->bytes[rows->size++] = (unsigned char)(value >> 8);
            pending = pending << kind->depth | value;
            for (pending_bits += kind->depth % 16 ? kind->depth : 8; pending_bits >= 8; pending_bits -= 8)
                rows->bytes[rows->size++] = (unsigned char)pending;
        }
    if (pending_bits > 0)
        rows->bytes[rows->size++] = (unsigned char)(pending << (8 - pending_bits));
}

static inline void png_make_rows(png_rows *rows, const png_kind *kind, png_sample *sample) {
    static const int passes[7][4] = {{0, 0, 8, 8}, {4, 0, 8, 8}, {0, 4, 4, 8}, {2, 0, 4, 4},
                                     {0, 2, 2, 4}, {1, 0, 2, 2}, {0, 1, 1, 2}}; /* x, y, step x, step y */
    static const int whole[4] = {0, 0, 1, 1};
    rows->size = 0;
    for (int i = 0; i < (kind->interlaced ? 7 : 1); i++) {
        const int *pass = kind->interlaced ? passes[i] : whole;
        for (int y = pass[1]; y < kind->height && pass[0] < kind->width; y += pass[3])
            png_row(rows, kind, sample, y, pass[0], pass[2]);
    }
}

/* An IDAT with the first `size` bytes of the rows as one zlib stream. */
static inline void png_data(png_file *file, const unsigned char *bytes, size_t size) {
    uint32_t a = 1, b = 0;
    png_start(file, "IDAT");
    png_put(file, 0x78);
    png_put(file, 0x01);
    for (size_t at = 0; at < size || at == 0; at += 65535) {
        size_t count = size - at < 65535 ? size - at : 65535;
        png_put(file, at + count == size);
        png_put(file, count & 255);
        png_put(file, (unsigned)(count >> 8));
        png_put(file, ~count & 255);
        png_put(file, (unsigned)(~count >> 8) & 255);
        for (size_t i = at; i < at + count; i++) {
            png_put(file, bytes[i]);
            a = (a + bytes[i]) % 65521;
            b = (b + a) % 65521;
        }
    }
    png_put32(file, b << 16 | a);
    png_finish(file);
}

/* IDAT and IEND. */
static inline void png_end(png_file *file, const png_kind *kind, png_sample *sample) {
    png_rows *rows = malloc(sizeof *rows);
    assert_non_null(rows);
    png_make_rows(rows, kind, sample);
    png_data(file, rows->bytes, rows->size);
    png_chunk(file, "IEND", "", 0);
    free(rows);
}

#endif
