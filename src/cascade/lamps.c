/* Distances to the nearest square of pixels that holds a small lamp, see lamps.h: first along rows, then the
 * least over columns. A few thousand squares, so the simple way will do. */
#include "cascade/lamps.h"

#include "job/jobs.h"

#include <math.h>

/* A lamp that holds a block of so many pixels a side is not small. */
#define LAMP_CORE 4
/* From the centre of a square to its corner, and what rounding may add [squares]. */
#define LAMP_SPARE 0.72f

dpl_status dpl_lamps_plan(dpl_survey *survey, dpl_context *context, const dpl_schedule *schedule) {
    const dpl_schedule_level *bottom = &schedule->levels[0]; /* its probes cover the picture */
    size_t columns = (size_t)(bottom->probes_x * bottom->spacing) / DPL_LAMP_TILE + 1;
    size_t rows = (size_t)(bottom->probes_y * bottom->spacing) / DPL_LAMP_TILE + 1;
    return dpl_buffer_reserve(context, &survey->lamp_tiles, columns * rows,
                              2 * sizeof(float) + sizeof(uint8_t));
}

/* What a square of pixels holds. */
enum { HOLDS_LAMP = 1, HOLDS_CORE = 2 };

static bool is_lamp(const dpl_field *field, int32_t x, int32_t y) {
    if (x >= field->width || y >= field->height || !dpl_field_is_opaque(field, x, y))
        return false;
    const float *rgb =
        ((const float(*)[4])field->emission.data)[(size_t)y * (size_t)field->width + (size_t)x];
    return rgb[0] > 0.0f || rgb[1] > 0.0f || rgb[2] > 0.0f;
}

/* Is all of the block to the right of and below a pixel lamp? */
static bool is_core(const dpl_field *field, int32_t x, int32_t y) {
    for (int32_t i = LAMP_CORE * LAMP_CORE - 1; i >= 0;
         i--) /* the far corner first: it is the likeliest to fail */
        if (!is_lamp(field, x + i % LAMP_CORE, y + i / LAMP_CORE))
            return false;
    return true;
}

/* Is the square empty by what is known of the pixel in its middle? */
static bool is_far_from_all(const dpl_field *field, int32_t column, int32_t row) {
    dpl_grid grid = dpl_field_grid(field);
    int32_t x = column * DPL_LAMP_TILE + DPL_LAMP_TILE / 2, y = row * DPL_LAMP_TILE + DPL_LAMP_TILE / 2;
    x = x < grid.width ? x : grid.width - 1;
    y = y < grid.height ? y : grid.height - 1;
    return grid.clearance[(size_t)y * (size_t)grid.width + (size_t)x] > (float)DPL_LAMP_TILE;
}

static int holdings(const dpl_field *field, int32_t column, int32_t row) {
    int found = 0;
    if (is_far_from_all(field, column, row))
        return 0;
    for (int32_t y = row * DPL_LAMP_TILE; y < (row + 1) * DPL_LAMP_TILE; y++)
        for (int32_t x = column * DPL_LAMP_TILE; x < (column + 1) * DPL_LAMP_TILE; x++)
            if (is_lamp(field, x, y)) {
                found |= HOLDS_LAMP;
                if (is_core(field, x, y))
                    return found | HOLDS_CORE;
            }
    return found;
}

/* A square holds a small lamp when it holds one, and neither it nor its neighbours hold the core of a large
 * one. */
static bool is_small(const uint8_t *held, int32_t columns, int32_t rows, int32_t x, int32_t y) {
    if (!(held[y * columns + x] & HOLDS_LAMP))
        return false;
    for (int32_t v = y > 0 ? y - 1 : 0; v <= y + 1 && v < rows; v++)
        for (int32_t u = x > 0 ? x - 1 : 0; u <= x + 1 && u < columns; u++)
            if (held[v * columns + u] & HOLDS_CORE)
                return false;
    return true;
}

/* Along each row: squares from here to the nearest one with a small lamp. False when there is none at all. */
static bool measure_rows(const uint8_t *held, int32_t columns, int32_t rows, float *run) {
    const float nowhere = (float)(columns + rows);
    bool any = false;
    for (int32_t y = 0; y < rows; y++, run += columns) {
        float since = nowhere;
        for (int32_t x = 0; x < columns; x++)
            any |= (run[x] = since =
                        is_small(held, columns, rows, x, y) ? 0.0f : fminf(since + 1.0f, nowhere)) == 0.0f;
        since = nowhere;
        for (int32_t x = columns - 1; x >= 0; x--)
            run[x] = since = fminf(run[x], since + 1.0f);
    }
    return any;
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

/* What the squares of a picture are looked at for. */
typedef struct squares {
    const dpl_field *field;
    int32_t columns, rows;
    float *distance, *run;
    uint8_t *held;
} squares;

static void find_holdings(int32_t begin, int32_t end, int32_t worker, void *task) {
    (void)worker;
    const squares *s = task;
    for (int32_t y = begin; y < end; y++)
        for (int32_t x = 0; x < s->columns; x++)
            s->held[y * s->columns + x] = (uint8_t)holdings(s->field, x, y);
}

static void find_nearest(int32_t begin, int32_t end, int32_t worker, void *task) {
    (void)worker;
    const squares *s = task;
    for (int32_t y = begin; y < end; y++)
        for (int32_t x = 0; x < s->columns; x++)
            s->distance[(size_t)y * (size_t)s->columns + (size_t)x] =
                nearest_lamp(s->run, s->columns, s->rows, x, y);
}

dpl_status dpl_lamps_measure(dpl_survey *survey, dpl_context *context, const dpl_field *field) {
    int32_t columns = (field->width + DPL_LAMP_TILE - 1) / DPL_LAMP_TILE;
    int32_t rows = (field->height + DPL_LAMP_TILE - 1) / DPL_LAMP_TILE;
    size_t count = (size_t)columns * (size_t)rows;
    float *distance = survey->lamp_tiles.data;
    squares s = {field, columns, rows, distance, distance + count, (uint8_t *)(distance + 2 * count)};
    DPL_TRY(dpl_jobs_run(context, find_holdings, rows, 1, &s));
    survey->has_lamps = measure_rows(s.held, columns, rows, s.run);
    if (survey->has_lamps)
        DPL_TRY(dpl_jobs_run(context, find_nearest, rows, 1, &s));
    survey->lamps = (dpl_clearances){columns, rows, distance, 1, LAMP_SPARE};
    return DPL_OK;
}
