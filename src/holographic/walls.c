/* What opaque pixels of the picture show when light was solved with bounces at another resolution: their
 * emission and what they reflect. Blocks and finer pixels know what they reflect themselves: a pixel has it
 * from them, by its own albedo. Called by resolution.c for each row. */
#include "holographic/resolution.h"

/* Walls darker than this do not tell how much light reaches them. */
#define DARK 1e-3f

/* Is something free before one of its sides? */
static bool is_exposed(const dpl_field *field, int32_t x, int32_t y) {
    return (x > 0 && !dpl_field_is_opaque(field, x - 1, y)) ||
           (x + 1 < field->width && !dpl_field_is_opaque(field, x + 1, y)) ||
           (y > 0 && !dpl_field_is_opaque(field, x, y - 1)) ||
           (y + 1 < field->height && !dpl_field_is_opaque(field, x, y + 1));
}

/* What white would reflect there, summed over those cells of the solved world that reflect. */
typedef struct white {
    float rgb[3];
    float count;
} white;

/* Adds a cell of the solved world where it is an exposed wall. */
static void add_cell(const dpl_hrc_resolution *r, int32_t x, int32_t y, white *sum) {
    const dpl_field *field = &r->field;
    if (x < 0 || y < 0 || x >= field->width || y >= field->height || !dpl_field_is_opaque(field, x, y) ||
        !is_exposed(field, x, y))
        return;
    size_t cell = dpl_field_cell(field, x, y);
    const float *emission = ((const float(*)[4])field->emission.data)[cell],
                *albedo = ((const float(*)[4])field->albedo.data)[cell], *light = dpl_hrc_light(r, 0, x, y);
    sum->count += 1.0f;
    for (int c = 0; c < 3; c++)
        if (albedo[c] > DARK && light[c] > emission[c])
            sum->rgb[c] += (light[c] - emission[c]) / albedo[c];
}

/* At a pixel, where one of its sides is exposed: of the four that it was split into; or of its block, and
 * where that is not a wall, of those around. */
static white white_at(const dpl_hrc_resampling *task, int32_t x, int32_t y) {
    const dpl_hrc_resolution *r = task->resolution;
    white sum = {{0.0f, 0.0f, 0.0f}, 0.0f};
    if (!is_exposed(task->field, x, y))
        return sum;
    if (r->kind == DPL_RESOLUTION_DOUBLE) {
        for (int32_t i = 0; i < 4; i++)
            add_cell(r, 2 * x + i % 2, 2 * y + i / 2, &sum);
        return sum;
    }
    add_cell(r, x / r->scale, y / r->scale, &sum);
    for (int32_t i = 0; i < DPL_AROUND && sum.count == 0.0f; i++)
        add_cell(r, x / r->scale + dpl_hrc_around[i][0], y / r->scale + dpl_hrc_around[i][1], &sum);
    return sum;
}

void dpl_hrc_show_walls(const dpl_hrc_resampling *task, int32_t y, float *const planes[3]) {
    const dpl_field *field = task->field;
    for (int32_t x = 0; x < field->width; x++) {
        if (!dpl_field_is_opaque(field, x, y))
            continue;
        size_t cell = dpl_field_cell(field, x, y);
        white sum = white_at(task, x, y);
        for (int c = 0; c < 3; c++) {
            planes[c][x] = ((const float(*)[4])field->emission.data)[cell][c];
            if (sum.count > 0.0f)
                planes[c][x] += ((const float(*)[4])field->albedo.data)[cell][c] * sum.rgb[c] / sum.count;
        }
    }
}
