/* Kernels that treat every element alike: one source for the scalar reference and for each instruction set,
 * where the compiler turns the loops into vectors by itself. Included by ref.c and vector.c. */
#ifndef DPL_KERNEL_LOOPS_H
#define DPL_KERNEL_LOOPS_H

#include <math.h>
#include <stdint.h>

/* ---- merge ---------------------------------------------------------------------------------------- */

static void merge(int32_t count, float *sum, const float *radiance, const float *transmittance,
                  const float *beyond, const float *weight) {
    for (int32_t i = 0; i < count; i++)
        sum[i] += weight[i] * (radiance[i] + transmittance[i] * beyond[i]);
}

static void accumulate(int32_t count, float *sum, const float *value, const float *weight) {
    for (int32_t i = 0; i < count; i++)
        sum[i] += weight[i] * value[i];
}

static void spread(int32_t count, float *out, const float *in) {
    for (int32_t m = 0; m < count / 2; m++) {
        out[2 * m] = in[m] + (in[m + 1] - in[m]) * 0.75f;
        out[2 * m + 1] = in[m + 1] + (in[m + 2] - in[m + 1]) * 0.25f;
    }
    if (count % 2)
        out[count - 1] = in[count / 2] + (in[count / 2 + 1] - in[count / 2]) * 0.75f;
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

/* ---- tone map ------------------------------------------------------------------------------------- */

static void tonemap(int32_t count, uint8_t *out, const float *mean) {
    for (int32_t i = 0; i < count; i++) {
        float x = mean[i] > 0.0f ? mean[i] : 0.0f; /* also for not-a-number */
        float base = 1.0f + 6.28318531f * x;
        float v = 1.0f - 1.0f / (base * base * sqrtf(base));
        out[i] = (uint8_t)(v * 255.0f + 0.5f);
    }
}

#endif
