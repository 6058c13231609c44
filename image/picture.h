/* Pictures in memory and on disk: PNG, PFM and (where built in) EXR. Used by scenes/, tools, tests and bench;
 * not part of the core library.
 *
 * Writing never leaves a half file: data goes to a temporary name beside the target and is renamed when it is
 * complete and flushed. */
#ifndef DPL_IMAGE_PICTURE_H
#define DPL_IMAGE_PICTURE_H

#include "error.h"

#include <dapple/image.h>
#include <stddef.h>
#include <stdint.h>

/* Largest width and height that is read [px]. */
#define DPL_PICTURE_MAX_SIZE 16384

/* Interleaved floats, rows top to bottom. */
typedef struct dpl_picture {
    int32_t width;
    int32_t height;
    int32_t channels; /* 1 grey, 2 grey+alpha, 3 RGB, 4 RGBA */
    float *data;      /* malloc'ed, shape [height][width][channels] */
    bool display;     /* colours are display-referred 0 .. 1 as stored in a PNG, not linear */
} dpl_picture;

/* What a PNG's colour channels become. PFM and EXR hold linear floats and ignore it. Alpha is never decoded.
 */
typedef enum dpl_picture_colour {
    DPL_PICTURE_LINEAR, /* sRGB decoded to linear */
    DPL_PICTURE_RAW     /* stored value / maximum, sets dpl_picture.display for colour read from PNG */
} dpl_picture_colour;

/* A picture of zeros. False when out of memory or a size is not in 1 .. DPL_PICTURE_MAX_SIZE. */
bool dpl_picture_create(dpl_picture *picture, int32_t width, int32_t height, int32_t channels,
                        dpl_error *error);

/* Frees the data and zeroes the picture. A zeroed picture is fine. */
void dpl_picture_free(dpl_picture *picture);

/* Views for the library. */
dpl_pixels dpl_picture_pixels(const dpl_picture *picture);
dpl_output dpl_picture_output(dpl_picture *picture);

/* Reads a file; its content, not its name, says which format it is. */
bool dpl_picture_read(const char *path, dpl_picture_colour colour, dpl_picture *picture, dpl_error *error);

/* The same from memory; `name` stands for the file in errors. */
bool dpl_picture_read_memory(const void *bytes, size_t size, const char *name, dpl_picture_colour colour,
                             dpl_picture *picture, dpl_error *error);

/* Can this path be written as linear floats or PNG, judging by its extension (.png .pfm .exr, or "-" for PFM
 * on standard output)? To refuse a wrong name before the work starts. */
bool dpl_picture_can_write(const char *path, dpl_error *error);

/* Writes linear floats: PFM (".pfm", or "-" = standard output) or EXR (".exr"). 3 channels are kept, others
 * become 3 (grey repeated, alpha left out). Values are written exactly as they are. */
bool dpl_picture_write(const char *path, const dpl_picture *picture, dpl_error *error);

/* Writes 8-bit pixels as PNG with an sRGB chunk. channels: 1, 3 or 4; rows tightly packed. */
bool dpl_picture_write_png(const char *path, int32_t width, int32_t height, int32_t channels,
                           const uint8_t *data, dpl_error *error);

/* Is EXR built in? */
bool dpl_picture_has_exr(void);

#endif
