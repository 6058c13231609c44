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

/* ---- light weighed by a cosine -------------------------------------------------------------------- */

/* Mean over the angles from..to of the cosine to the axis, and of that to the nearer way across. */
static double mean_along(double from, double to) {
    return (sin(to) - sin(from)) / (to - from);
}

static double mean_across(double from, double to) {
    return fabs(cos(to) - cos(from)) / (to - from);
}

/* Levels 2 to 1: what the cones of level 2 bring is weighed by their mean cosine. Levels 1 to 0: that only
 * what the segments emit on the way, which the cones of level 1 see. */
static void fill_table(dpl_hrc_lens_table *table, const float *weights, const float (*sky)[3],
                       double (*mean)(double, double)) {
    for (int32_t n = 1; n <= 2; n++)
        for (int32_t i = 0; i < 1 << n; i++) {
            int32_t cone = dpl_hrc_cone(n, i);
            table->emitted[cone] = weights[cone] * (float)mean(angle_of(n, i), angle_of(n, i + 1));
            table->passed[cone] = n == 2 ? table->emitted[cone] : weights[cone];
            memcpy(table->sky[cone], sky[cone], sizeof table->sky[cone]);
        }
    for (int32_t cone = 3; cone >= 1; cone--)
        for (int c = 0; c < 3; c++)
            table->sky[cone][c] = table->passed[2 * cone] * table->sky[2 * cone][c] +
                                  table->passed[2 * cone + 1] * table->sky[2 * cone + 1][c];
}

/* One of the two cones of level 1 alone. */
static void keep_half(dpl_hrc_lens_table *table, const dpl_hrc_lens_table *whole, int32_t half) {
    *table = *whole;
    int32_t kept = dpl_hrc_cone(1, half), left = dpl_hrc_cone(1, 1 - half);
    table->emitted[left] = table->passed[left] = 0.0f;
    for (int c = 0; c < 3; c++)
        table->sky[dpl_hrc_cone(0, 0)][c] = table->passed[kept] * table->sky[kept][c];
}

static void fill_tables(dpl_hrc_lens_table tables[DPL_HRC_TABLES], const float *weights,
                        const float (*sky)[3]) {
    fill_table(&tables[DPL_TABLE_ALONG], weights, sky, mean_along);
    fill_table(&tables[DPL_TABLE_ACROSS], weights, sky, mean_across);
    keep_half(&tables[DPL_TABLE_BELOW], &tables[DPL_TABLE_ACROSS], 0);
    keep_half(&tables[DPL_TABLE_ABOVE], &tables[DPL_TABLE_ACROSS], 1);
}

/* ---- the sky -------------------------------------------------------------------------------------- */

static void fill_cones(const dpl_field *field, int32_t quadrant, int32_t levels, float (*sky)[3]) {
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

void dpl_hrc_fill_sky(dpl_hrc *hrc, const dpl_field *field) {
    const dpl_hrc_layout *l = &hrc->layout;
    char *arena = hrc->arena.data;
    const float *weights = (const float *)(const void *)(arena + l->weights);
    float(*sky)[3] = (float(*)[3])(void *)(arena + l->sky);
    dpl_hrc_lens_table *tables = (dpl_hrc_lens_table *)(void *)(arena + l->lenses);
    for (int32_t quadrant = 0; quadrant < 4; quadrant++) {
        fill_cones(field, quadrant, l->levels, sky);
        fill_tables(tables, weights, (const float(*)[3])sky);
        sky += (size_t)2 << l->levels;
        tables += DPL_HRC_TABLES;
    }
}
