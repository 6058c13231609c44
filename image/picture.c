/* A picture in memory: made, freed, viewed, read by row. Called by the readers and writers and by all who
 * hold pictures. */
#include "picture.h"
#include "formats.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

#define TEXT_LIMIT 200

static bool size_is_fine(int64_t width, int64_t height) {
    return width >= 1 && height >= 1 && width <= DPL_PICTURE_MAX_SIZE && height <= DPL_PICTURE_MAX_SIZE;
}

static bool create(dpl_picture *picture, int32_t width, int32_t height, int32_t channels) {
    size_t pixels = (size_t)width * (size_t)height;
    float *data = calloc(pixels, (size_t)channels * sizeof *data);
    if (!data)
        return false;
    *picture = (dpl_picture){.width = width, .height = height, .channels = channels, .data = data};
    return true;
}

bool dpl_picture_create(dpl_picture *picture, int32_t width, int32_t height, int32_t channels,
                        dpl_error *error) {
    *picture = (dpl_picture){0};
    if (!size_is_fine(width, height))
        return dpl_error_set(error,
                             "a picture of %" PRId32 " x %" PRId32 " pixels: 1 .. %d a side are possible",
                             width, height, DPL_PICTURE_MAX_SIZE);
    if (channels < 1 || channels > 4)
        return dpl_error_set(error, "a picture of %" PRId32 " channels: 1 .. 4 are possible", channels);
    if (!create(picture, width, height, channels))
        return dpl_error_set(error, "a picture of %" PRId32 " x %" PRId32 " pixels: out of memory", width,
                             height);
    return true;
}

bool dpl_picture_create_read(const dpl_picture_source *source, int64_t width, int64_t height,
                             int32_t channels, dpl_picture *picture, dpl_error *error) {
    if (!size_is_fine(width, height))
        return dpl_error_set(error, "%s: %" PRId64 " x %" PRId64 " pixels: 1 .. %d a side are possible",
                             source->name, width, height, DPL_PICTURE_MAX_SIZE);
    if (!create(picture, (int32_t)width, (int32_t)height, channels))
        return dpl_error_set(error, "%s: out of memory", source->name);
    return true;
}

bool dpl_picture_broken(const dpl_picture_source *source, const char *format, const char *text,
                        dpl_error *error) {
    char shown[TEXT_LIMIT];
    size_t size = 0;
    for (; text[size] && size + 1 < sizeof shown; size++)
        shown[size] = text[size] >= ' ' && text[size] <= '~' ? text[size] : '?';
    shown[size] = 0;
    return dpl_error_set(error, "%s: broken %s: %s", source->name, format, shown);
}

void dpl_picture_free(dpl_picture *picture) {
    free(picture->data);
    *picture = (dpl_picture){0};
}

dpl_pixels dpl_picture_pixels(const dpl_picture *picture) {
    return (dpl_pixels){.data = picture->data,
                        .format = DPL_FORMAT_F32,
                        .width = picture->width,
                        .height = picture->height,
                        .channels = picture->channels};
}

dpl_output dpl_picture_output(dpl_picture *picture) {
    return (dpl_output){.data = picture->data,
                        .width = picture->width,
                        .height = picture->height,
                        .channels = picture->channels};
}

void dpl_picture_rgb_row(const dpl_picture *picture, int32_t y, float *rgb) {
    size_t channels = (size_t)picture->channels, width = (size_t)picture->width;
    const float *row = picture->data + (size_t)y * width * channels;
    size_t green = channels >= 3 ? 1 : 0, blue = channels >= 3 ? 2 : 0;
    for (size_t x = 0; x < width; x++) { /* copied as bytes: a signalling NaN stays one */
        memcpy(rgb + 3 * x, row + channels * x, sizeof *rgb);
        memcpy(rgb + 3 * x + 1, row + channels * x + green, sizeof *rgb);
        memcpy(rgb + 3 * x + 2, row + channels * x + blue, sizeof *rgb);
    }
}
