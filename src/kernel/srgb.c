/* Tables of the sRGB curve. Filled by src/field/reader.c and src/api/lightmap.c for the length of a call. */
#include "kernel/srgb.h"

#include <math.h>

double dpl_srgb_byte_to_linear(double byte) {
    double encoded = byte / 255.0;
    return encoded <= 0.04045 ? encoded / 12.92 : pow((encoded + 0.055) / 1.055, 2.4);
}

void dpl_srgb_steps_fill(dpl_srgb_steps *steps) {
    int32_t code = 0;
    float next = (float)dpl_srgb_byte_to_linear(0.5);
    for (int32_t i = 0; i < SRGB_STEPS; i++) {
        int32_t bits = SRGB_LOWEST_BITS + (i << SRGB_STEP_SHIFT);
        float start;
        memcpy(&start, &bits, sizeof start);
        if (start >= next) {
            code++;
            next = code < 255 ? (float)dpl_srgb_byte_to_linear(code + 0.5) : HUGE_VALF;
        }
        steps->code[i] = (float)code;
        steps->next[i] = next;
    }
}
