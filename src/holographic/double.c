/* The world at twice the resolution: each pixel as four of the same material, extinction halved so that
 * crossing two of them is crossing it; and the mean of what the four receive. Called by resolution.c. */
#include "holographic/resolution.h"

static void split_extinction(const float from[4], float to[4]) {
    for (int c = 0; c < 4; c++) /* what is opaque in one channel stays so */
        to[c] = from[c] < DPL_EXTINCTION_MAX ? 0.5f * from[c] : DPL_EXTINCTION_MAX;
}

static void split_row(const dpl_field *field, const dpl_field *to, int32_t y) {
    const uint8_t *kind = field->kind.data;
    const float(*emission)[4] = (const float(*)[4])field->emission.data;
    const float(*extinction)[4] = (const float(*)[4])field->extinction.data;
    const float(*albedo)[4] = (const float(*)[4])field->albedo.data;
    for (int32_t x = 0; x < to->width; x++) {
        size_t cell = dpl_field_cell(field, x / 2, y / 2), own = dpl_field_cell(to, x, y);
        ((uint8_t *)to->kind.data)[own] = kind[cell];
        memcpy(((float(*)[4])to->emission.data)[own], emission[cell], sizeof *emission);
        if (extinction)
            split_extinction(extinction[cell], ((float(*)[4])to->extinction.data)[own]);
        if (albedo)
            memcpy(((float(*)[4])to->albedo.data)[own], albedo[cell], sizeof *albedo);
    }
}

void dpl_hrc_split_task(int32_t begin, int32_t end, int32_t worker, void *resampling) {
    const dpl_hrc_resampling *task = resampling;
    (void)worker;
    for (int32_t y = 2 * begin; y < 2 * end; y++)
        split_row(task->field, &task->resolution->field, y);
}

size_t dpl_hrc_join_floats(const dpl_hrc_resolution *r, const dpl_field *field) {
    return (size_t)r->target_count * 3 * (size_t)field->width;
}

/* Pixels of row y of the field, in one target. */
static void join_row(const dpl_hrc_resolution *r, int32_t target, int32_t y, int32_t width,
                     float *const planes[3]) {
    const float *above = dpl_hrc_light(r, target, 0, 2 * y), *below = dpl_hrc_light(r, target, 0, 2 * y + 1);
    for (int32_t x = 0; x < width; x++)
        for (int32_t c = 0; c < 3; c++)
            planes[c][x] =
                0.25f * (above[6 * x + c] + above[6 * x + 3 + c] + below[6 * x + c] + below[6 * x + 3 + c]);
}

void dpl_hrc_join_task(int32_t begin, int32_t end, int32_t worker, void *resampling) {
    const dpl_hrc_resampling *task = resampling;
    const dpl_hrc_resolution *r = task->resolution;
    int32_t width = task->field->width;
    float *planes[DPL_HRC_TARGETS * 3], *floats = r->memory[DPL_MEMORY_ROWS].data;
    floats += (size_t)worker * dpl_hrc_join_floats(r, task->field);
    for (int32_t i = 0; i < r->target_count * 3; i++)
        planes[i] = floats + (size_t)i * (size_t)width;
    for (int32_t y = begin + task->field->margin; y < end + task->field->margin; y++) {
        for (int32_t target = 0; target < r->target_count; target++)
            join_row(r, target, y, width, planes + (size_t)target * 3);
        dpl_hrc_write_targets(task, y, planes);
    }
}
