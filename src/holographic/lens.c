/* What cones weigh and what sky they see. Cone i of level n lies between the slopes 2i/2^n - 1 and
 * 2(i+1)/2^n - 1 across the gather axis. */
#include "holographic/holographic.h"

#include <math.h>

#define QUARTER_TURN 1.57079632679489661923

/* Angle of ray `ray` of a level, from the gather axis. */
static double angle_of(int32_t level, int32_t ray) {
    double reach = (double)(1 << level);
    return atan2(2.0 * ray - reach, reach);
}

/* The mean of the sky over angles from..to across the gather axis of a quadrant. */
static void sky_through(const dpl_field *field, int32_t quadrant, double from, double to, float rgb[3]) {
    switch (quadrant) {
    case 0: /* along +x, across +y */
        dpl_field_sky_mean(field, from, to, rgb);
        break;
    case 1: /* along -x, across +y */
        dpl_field_sky_mean(field, 2.0 * QUARTER_TURN - to, 2.0 * QUARTER_TURN - from, rgb);
        break;
    case 2: /* along +y, across +x */
        dpl_field_sky_mean(field, QUARTER_TURN - to, QUARTER_TURN - from, rgb);
        break;
    default: /* along -y, across +x */
        dpl_field_sky_mean(field, from - QUARTER_TURN, to - QUARTER_TURN, rgb);
    }
}

/* weights[cone i of level n+1] is its share of the cone of level n that it lies in. */
void dpl_hrc_fill_weights(dpl_hrc *hrc) {
    float *weights = (float *)(void *)((char *)hrc->arena.data + hrc->layout.weights);
    weights[dpl_hrc_cone(0, 0)] = 1.0f;
    for (int32_t n = 1; n <= hrc->layout.levels; n++)
        for (int32_t i = 0; i < 1 << n; i++) {
            double share = angle_of(n, i + 1) - angle_of(n, i);
            double whole = angle_of(n - 1, i / 2 + 1) - angle_of(n - 1, i / 2);
            weights[dpl_hrc_cone(n, i)] = (float)(share / whole);
        }
}

void dpl_hrc_fill_sky(dpl_hrc *hrc, const dpl_field *field) {
    int32_t levels = hrc->layout.levels;
    float(*sky)[3] = (float(*)[3])(void *)((char *)hrc->arena.data + hrc->layout.sky);
    for (int32_t quadrant = 0; quadrant < 4; quadrant++, sky += (size_t)2 << levels)
        for (int32_t n = 0; n <= levels; n++)
            for (int32_t i = 0; i < 1 << n; i++) {
                float *rgb = sky[dpl_hrc_cone(n, i)];
                if (field->sky_count == 1)
                    memcpy(rgb, field->sky.data, sizeof *sky);
                else
                    sky_through(field, quadrant, angle_of(n, i), angle_of(n, i + 1), rgb);
                for (int c = 0; c < 3; c++)
                    rgb[c] = fminf(rgb[c], DPL_RADIANCE_MAX);
            }
}
