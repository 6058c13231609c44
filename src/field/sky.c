/* The sky outside the world: a ring of equal sectors of constant radiance. Set by src/api/field.c, looked up
 * by solvers. */
#include "field/field.h"

static const double TURN = 6.28318530717958647692;

dpl_status dpl_field_hold_sky(dpl_field *field, const float (*rgb)[3], int32_t count) {
    DPL_TRY(dpl_buffer_reserve(field->context, &field->sky, (size_t)count, sizeof *rgb));
    memcpy(field->sky.data, rgb, (size_t)count * sizeof *rgb);
    field->sky_count = count;
    return DPL_OK;
}

/* Sectors from angle 0 to `angle`, a whole and a fractional number of them. */
static double sectors_before(const dpl_field *field, double angle) {
    return angle / TURN * field->sky_count;
}

/* How many of them are whole turns. */
static double sectors_of_turns(const dpl_field *field, double sectors) {
    return floor(sectors / field->sky_count) * field->sky_count;
}

const float *dpl_field_sky_at(const dpl_field *field, double angle) {
    const float(*sky)[3] = (const float(*)[3])field->sky.data;
    double sectors = sectors_before(field, angle);
    return sky[(int32_t)(sectors - sectors_of_turns(field, sectors)) % field->sky_count];
}

static void add_sector(double sum[3], const float rgb[3], double weight) {
    for (int c = 0; c < 3; c++)
        sum[c] += weight * (double)rgb[c];
}

/* Whole turns count at once; what is left over is at most a turn and goes sector by sector. */
void dpl_field_sky_mean(const dpl_field *field, double from, double to, float rgb[3]) {
    const float(*sky)[3] = (const float(*)[3])field->sky.data;
    if (field->sky_count == 1) {
        memcpy(rgb, sky, sizeof *sky);
        return;
    }
    double at = sectors_before(field, from), end = sectors_before(field, to), sum[3] = {0.0, 0.0, 0.0};
    double width = end - at, skipped = sectors_of_turns(field, at), round = sectors_of_turns(field, width);
    if (floor(at) == floor(end)) { /* one sector: its radiance to the last bit */
        memcpy(rgb, dpl_field_sky_at(field, from), sizeof *sky);
        return;
    }
    for (int32_t i = 0; round > 0.0 && i < field->sky_count; i++)
        add_sector(sum, sky[i], round / field->sky_count);
    at -= skipped;
    end -= skipped + round;
    while (at < end) {
        double edge = fmin(floor(at) + 1.0, end);
        add_sector(sum, sky[(int32_t)at % field->sky_count], edge - at);
        at = edge;
    }
    for (int c = 0; c < 3; c++)
        rgb[c] = (float)(sum[c] / width);
}
