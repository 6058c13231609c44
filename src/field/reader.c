/* Runs of pixels of any format as floats. Called by layer.c and src/api/lightmap.c. */
#include "field/reader.h"

#include "base/layout.h"
#include "kernel/srgb.h"

#include <string.h>

void dpl_byte_values_fill(dpl_byte_values *values, dpl_format format) {
    if (format != DPL_FORMAT_UNORM8 && format != DPL_FORMAT_SRGB8)
        return;
    for (int i = 0; i < 256; i++) {
        values->alpha[i] = (float)i / 255.0f;
        values->colour[i] = format == DPL_FORMAT_SRGB8 ? (float)dpl_srgb_decode(i / 255.0) : values->alpha[i];
    }
}

/* What most pictures are, a pixel at a time: half the instructions. */
static void read_rgba_bytes(const dpl_byte_values *values, const uint8_t *from, int32_t count, float *out) {
    for (int32_t i = 0; i < count; i++, from += 4, out += 4) {
        out[0] = values->colour[from[0]];
        out[1] = values->colour[from[1]];
        out[2] = values->colour[from[2]];
        out[3] = values->alpha[from[3]];
    }
}

static void read_bytes(const dpl_pixels *pixels, const dpl_byte_values *values, const uint8_t *from,
                       int32_t count, float *out) {
    int32_t channels = pixels->channels, alpha = dpl_pixels_have_alpha(pixels) ? channels - 1 : -1;
    for (int32_t i = 0; i < count * channels; i++)
        out[i] = values->colour[from[i]];
    for (int32_t i = alpha; alpha >= 0 && i < count * channels; i += channels)
        out[i] = values->alpha[from[i]];
}

void dpl_read_run(const dpl_kernels *kernels, const dpl_pixels *pixels, const dpl_byte_values *values,
                  int32_t x, int32_t y, int32_t count, float *out) {
    size_t channel = dpl_format_bytes(pixels->format), numbers = (size_t)(count * pixels->channels);
    const char *from =
        (const char *)pixels->data + pixels->row_stride * y + (size_t)x * (size_t)pixels->channels * channel;
    uint16_t halves[4 * DPL_RUN];
    switch (pixels->format) {
    case DPL_FORMAT_F32:
        memcpy(out, from, numbers * channel);
        break;
    case DPL_FORMAT_F16:
        memcpy(halves, from, numbers * channel); /* which also aligns them */
        kernels->float_from_half((int32_t)numbers, out, halves);
        break;
    case DPL_FORMAT_UNORM8:
    case DPL_FORMAT_SRGB8:
        if (pixels->channels == 4)
            read_rgba_bytes(values, (const uint8_t *)from, count, out);
        else
            read_bytes(pixels, values, (const uint8_t *)from, count, out);
        break;
    }
}
