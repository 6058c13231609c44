/* One reader and one writer per picture format, and what they share. Internal to image/. */
#ifndef DPL_IMAGE_FORMATS_H
#define DPL_IMAGE_FORMATS_H

#include "picture.h"

/* A picture file in memory. */
typedef struct dpl_picture_source {
    const unsigned char *bytes;
    size_t size;
    const char *name; /* stands for the file in errors */
    dpl_picture_colour colour;
} dpl_picture_source;

/* Readers: the picture is zeroed when they are called, and on failure they leave it so. */
bool dpl_png_read(const dpl_picture_source *source, dpl_picture *picture, dpl_error *error);
bool dpl_pfm_read(const dpl_picture_source *source, dpl_picture *picture, dpl_error *error);
bool dpl_exr_read(const dpl_picture_source *source, dpl_picture *picture, dpl_error *error);

/* Writers of linear floats; the picture is known to be whole. */
bool dpl_pfm_write(const char *path, const dpl_picture *picture, dpl_error *error);
bool dpl_exr_write(const char *path, const dpl_picture *picture, dpl_error *error);

/* dpl_picture_create() with the file's name in the error. Takes what a header says, however large. */
bool dpl_picture_create_read(const dpl_picture_source *source, int64_t width, int64_t height,
                             int32_t channels, dpl_picture *picture, dpl_error *error);

/* Sets "NAME: broken FORMAT: TEXT" and returns false. The text may come from a library and quote the file:
 * bytes that do not print are masked. */
bool dpl_picture_broken(const dpl_picture_source *source, const char *format, const char *text,
                        dpl_error *error);

/* Row `y` of a picture as width x 3 floats, bit for bit: grey is repeated, alpha left out. */
void dpl_picture_rgb_row(const dpl_picture *picture, int32_t y, float *rgb);

#endif
