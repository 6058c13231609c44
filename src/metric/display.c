/* Rows to 8 bits. Called by pair.c, difference.c, flip.c and dpl_tonemap(). */
#include "metric/display.h"

/* Pixels that are packed to three channels at a time: a few KiB of stack. */
#define CHUNK 256

void dpl_tonemap_row(const dpl_kernels *kernels, const float *row, int32_t channels, int32_t width,
                     uint8_t *rgb) {
    if (channels == 3) {
        kernels->tonemap(3 * width, rgb, row);
        return;
    }
    float packed[3 * CHUNK];
    for (int32_t begin = 0; begin < width; begin += CHUNK) {
        const int32_t count = width - begin < CHUNK ? width - begin : CHUNK;
        for (int32_t i = 0; i < count; i++)
            for (int32_t c = 0; c < 3; c++)
                packed[3 * i + c] = row[(begin + i) * channels + c];
        kernels->tonemap(3 * count, rgb + 3 * begin, packed);
    }
}

static uint8_t quantise(float v) {
    const double scaled = (double)v * 255.0;
    return (uint8_t)(scaled > 0.0 ? scaled < 255.0 ? scaled + 0.5 : 255.0 : 0.0);
}

void dpl_quantise_row(const float *row, int32_t channels, int32_t width, uint8_t *rgb) {
    for (int32_t x = 0; x < width; x++)
        for (int32_t c = 0; c < 3; c++)
            rgb[3 * x + c] = quantise(row[x * channels + c]);
}
