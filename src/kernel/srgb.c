/* The sRGB curve and its table. Called by src/field/reader.c, src/api/lightmap.c and src/metric/. */
#include "kernel/srgb.h"

#include <math.h>

double dpl_srgb_decode(double encoded) {
    return encoded > 0.04045 ? pow((encoded + 0.055) / 1.055, 2.4) : encoded / 12.92;
}

void dpl_srgb_steps_fill(dpl_srgb_steps *steps) {
    int32_t code = 0;
    float next = (float)dpl_srgb_decode(0.5 / 255.0);
    for (int32_t i = 0; i < SRGB_STEPS; i++) {
        int32_t bits = SRGB_LOWEST_BITS + (i << SRGB_STEP_SHIFT);
        float start;
        memcpy(&start, &bits, sizeof start);
        if (start >= next) {
            code++;
            next = code < 255 ? (float)dpl_srgb_decode((code + 0.5) / 255.0) : HUGE_VALF;
        }
        steps->code[i] = (float)code;
        steps->next[i] = next;
    }
}
