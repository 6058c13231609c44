/* Kernels that treat every element alike: one source for the scalar reference and for each instruction set,
 * where the compiler turns the loops into vectors by itself. Included by ref.c and vector.c. */
#ifndef DPL_KERNEL_LOOPS_H
#define DPL_KERNEL_LOOPS_H

#include <math.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* ---- rays of probes ------------------------------------------------------------------------------- */

static void aim_row(int32_t count, float *const ends[4], const float *x, const float start[2],
                    const float *target_x, const float end[2]) {
    float *x0 = ends[0], *y0 = ends[1], *x1 = ends[2], *y1 = ends[3];
    for (int32_t i = 0; i < count; i++)
        x0[i] = x[i] + start[0];
    for (int32_t i = 0; i < count; i++)
        y0[i] = start[1];
    for (int32_t i = 0; i < count; i++)
        x1[i] = target_x[i] + end[0];
    for (int32_t i = 0; i < count; i++)
        y1[i] = end[1];
}

/* ---- distance transform --------------------------------------------------------------------------- */

static void distance_down(int32_t count, int32_t *run, const uint8_t *occupied, const int32_t *before) {
    for (int32_t i = 0; i < count; i++)
        run[i] = occupied[i] ? 0 : before[i] + 1;
}

static void distance_up(int32_t count, int32_t *run, const int32_t *after) {
    for (int32_t i = 0; i < count; i++)
        run[i] = run[i] < after[i] + 1 ? run[i] : after[i] + 1;
}

/* ---- holographic: in and out ----------------------------------------------------------------------- */

/* One pixel of planes r, g, b, t. */
static inline void opaque_pixel(float *planes, size_t stride, uint8_t kind, const float emission[4]) {
    float solid = kind == 2 ? 1.0f : 0.0f;
    for (size_t c = 0; c < 3; c++)
        planes[c * stride] = (emission[c] < DPL_RADIANCE_MAX ? emission[c] : DPL_RADIANCE_MAX) * solid;
    planes[3 * stride] = 1.0f - solid;
}

/* In tiles that stay in the nearest cache on both sides. */
enum { TRANSPOSE_TILE = 16 };

static inline void transpose_plain(int32_t rows, int32_t columns, float *out, size_t out_step,
                                   const float *in, size_t in_step) {
    for (int32_t first = 0; first < rows; first += TRANSPOSE_TILE) {
        int32_t behind = first + TRANSPOSE_TILE < rows ? first + TRANSPOSE_TILE : rows;
        for (int32_t column = 0; column < columns; column++)
            for (int32_t row = first; row < behind; row++)
                out[(size_t)column * out_step + (size_t)row] = in[(size_t)row * in_step + (size_t)column];
    }
}

static inline void transpose_halves_plain(int32_t rows, int32_t columns, uint16_t *out, size_t out_step,
                                          const uint16_t *in, size_t in_step) {
    for (int32_t first = 0; first < rows; first += TRANSPOSE_TILE) {
        int32_t behind = first + TRANSPOSE_TILE < rows ? first + TRANSPOSE_TILE : rows;
        for (int32_t column = 0; column < columns; column++)
            for (int32_t row = first; row < behind; row++)
                out[(size_t)column * out_step + (size_t)row] = in[(size_t)row * in_step + (size_t)column];
    }
}

static inline void interleave_plain(int32_t count, float (*rgb)[3], const float *const planes[3],
                                    bool streams) {
    (void)streams;
    const float *red = planes[0], *green = planes[1], *blue = planes[2];
    for (int32_t i = 0; i < count; i++) {
        rgb[i][0] = red[i];
        rgb[i][1] = green[i];
        rgb[i][2] = blue[i];
    }
}

static void add_scaled(int32_t count, float *out, const float *in, float weight, bool add) {
    if (add)
        for (int32_t i = 0; i < count; i++)
            out[i] = out[i] + weight * in[i];
    else
        for (int32_t i = 0; i < count; i++)
            out[i] = weight * in[i];
}

static void filter_cross(int32_t count, float *out, const float *const values[3],
                         const float *const is_free[3]) {
    const float *above = values[0], *at = values[1], *below = values[2];
    const float *free_above = is_free[0], *free_at = is_free[1], *free_below = is_free[2];
    for (int32_t i = 0; i < count; i++) {
        float across = free_above[i] * free_below[i], along = free_at[i - 1] * free_at[i + 1];
        float sum = 4.0f * at[i] + across * (above[i] + below[i]) + along * (at[i - 1] + at[i + 1]);
        out[i] = sum / (4.0f + 2.0f * across + 2.0f * along);
    }
}

/* ---- bytes ---------------------------------------------------------------------------------------- */

/* One value; the loops over them are vectors in vector.c, for compilers do not make any here. */
static inline uint8_t tonemap_one(float mean) {
    float x = mean > 0.0f ? mean : 0.0f; /* also for not-a-number */
    float base = 1.0f + 6.28318531f * x;
    float v = 1.0f - 1.0f / (base * base * sqrtf(base));
    return (uint8_t)(v * 255.0f + 0.5f);
}

static inline uint8_t byte_from_linear(float in) {
    float v = in > 0.0f ? in : 0.0f; /* also for not-a-number */
    v = v < 1.0f ? v : 1.0f;
    return (uint8_t)(int32_t)(v * 255.0f + 0.5f);
}

#endif
