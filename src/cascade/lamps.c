/* Distances to the nearest square of pixels that holds a lamp, see lamps.h: first along rows, then the least
 * over columns. A few thousand squares, so the simple way will do. */
#include "cascade/lamps.h"

#include <math.h>

/* From the centre of a square to its corner, and what rounding may add [squares]. */
#define LAMP_SPARE 0.72f

dpl_status dpl_lamps_plan(dpl_survey *survey, dpl_context *context, const dpl_schedule *schedule) {
    const dpl_schedule_level *bottom = &schedule->levels[0]; /* its probes cover the picture */
    size_t columns = (size_t)(bottom->probes_x * bottom->spacing) / DPL_LAMP_TILE + 1;
    size_t rows = (size_t)(bottom->probes_y * bottom->spacing) / DPL_LAMP_TILE + 1;
    return dpl_buffer_reserve(context, &survey->lamp_tiles, 2 * columns * rows, sizeof(float));
}

static bool has_lamp(const dpl_field *field, int32_t column, int32_t row) {
    const float(*emission)[4] = (const float(*)[4])field->emission.data;
    for (int32_t y = row * DPL_LAMP_TILE; y < (row + 1) * DPL_LAMP_TILE && y < field->height; y++)
        for (int32_t x = column * DPL_LAMP_TILE; x < (column + 1) * DPL_LAMP_TILE && x < field->width; x++) {
            const float *rgb = emission[(size_t)y * (size_t)field->width + (size_t)x];
            if (dpl_field_is_opaque(field, x, y) && (rgb[0] > 0.0f || rgb[1] > 0.0f || rgb[2] > 0.0f))
                return true;
        }
    return false;
}

/* Along each row: squares from here to the nearest one with a lamp. */
static void measure_rows(const dpl_field *field, int32_t columns, int32_t rows, float *run) {
    const float nowhere = (float)(columns + rows);
    for (int32_t y = 0; y < rows; y++, run += columns) {
        float since = nowhere;
        for (int32_t x = 0; x < columns; x++)
            run[x] = since = has_lamp(field, x, y) ? 0.0f : fminf(since + 1.0f, nowhere);
        since = nowhere;
        for (int32_t x = columns - 1; x >= 0; x--)
            run[x] = since = fminf(run[x], since + 1.0f);
    }
}

/* Looks at rows ever further away until they cannot hold a nearer one. */
static float nearest_lamp(const float *run, int32_t columns, int32_t rows, int32_t x, int32_t y) {
    float least = HUGE_VALF;
    for (int32_t away = 0; away < rows && (float)away * (float)away < least; away++)
        for (int32_t v = y - away; v <= y + away; v += away > 0 ? 2 * away : 1) {
            if (v < 0 || v >= rows)
                continue;
            float dx = run[(size_t)v * (size_t)columns + (size_t)x], dy = (float)away;
            least = fminf(least, dx * dx + dy * dy);
        }
    return sqrtf(least);
}

void dpl_lamps_measure(dpl_survey *survey, const dpl_field *field) {
    int32_t columns = (field->width + DPL_LAMP_TILE - 1) / DPL_LAMP_TILE;
    int32_t rows = (field->height + DPL_LAMP_TILE - 1) / DPL_LAMP_TILE;
    float *distance = survey->lamp_tiles.data, *run = distance + (size_t)columns * (size_t)rows;
    measure_rows(field, columns, rows, run);
    for (int32_t y = 0; y < rows; y++)
        for (int32_t x = 0; x < columns; x++)
            distance[(size_t)y * (size_t)columns + (size_t)x] = nearest_lamp(run, columns, rows, x, y);
    survey->lamps = (dpl_distances){columns, rows, distance, 1, LAMP_SPARE};
}
