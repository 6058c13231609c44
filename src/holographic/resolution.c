/* Memory and order of work of a solve at another resolution. Called by holographic.c. */
#include "holographic/resolution.h"

#include "job/jobs.h"

/* ---- size and memory ------------------------------------------------------------------------------ */

static void size_field(dpl_hrc_resolution *r, const dpl_field *field) {
    static const int32_t scales[] = {
        [DPL_RESOLUTION_HALF] = 2, [DPL_RESOLUTION_QUARTER] = 4, [DPL_RESOLUTION_DOUBLE] = 1};
    bool finer = r->kind == DPL_RESOLUTION_DOUBLE;
    r->scale = scales[r->kind];
    r->field = (dpl_field){
        .context = field->context,
        .width = finer ? 2 * field->width : (field->width + r->scale - 1) / r->scale,
        .height = finer ? 2 * field->height : (field->height + r->scale - 1) / r->scale,
        .sky_count = field->sky_count,
        .sky = field->sky,
    };
}

/* Room for a value per pixel of the world on its own grid. */
static dpl_status hold(dpl_hrc_resolution *r, dpl_hrc_memory which, size_t bytes) {
    return dpl_buffer_reserve(r->field.context, &r->memory[which], dpl_field_pixels(&r->field), bytes);
}

static dpl_status lend(dpl_hrc_resolution *r, dpl_hrc_memory which, size_t bytes, dpl_buffer *plane) {
    DPL_TRY(hold(r, which, bytes));
    *plane = r->memory[which];
    return DPL_OK;
}

/* Planes of the world, those that the caller's has too. */
static dpl_status hold_field(dpl_hrc_resolution *r, const dpl_field *field) {
    DPL_TRY(lend(r, DPL_MEMORY_KIND, 1, &r->field.kind));
    DPL_TRY(lend(r, DPL_MEMORY_EMISSION, sizeof(float[4]), &r->field.emission));
    if (field->extinction.data)
        DPL_TRY(lend(r, DPL_MEMORY_EXTINCTION, sizeof(float[4]), &r->field.extinction));
    if (field->albedo.data)
        DPL_TRY(lend(r, DPL_MEMORY_ALBEDO, sizeof(float[4]), &r->field.albedo));
    return DPL_OK;
}

static dpl_status hold_targets(dpl_hrc_resolution *r, const dpl_targets *targets) {
    r->target_count = targets->cosine.data ? DPL_HRC_TARGETS : 1;
    DPL_TRY(hold(r, DPL_MEMORY_LIGHT, (size_t)r->target_count * sizeof(float[3])));
    dpl_output outputs[DPL_HRC_TARGETS] = {{0}};
    for (int32_t target = 0; target < r->target_count; target++)
        outputs[target] = (dpl_output){
            .data = dpl_hrc_light(r, target, 0, 0),
            .width = r->field.width,
            .height = r->field.height,
            .channels = 3,
            .row_stride = (ptrdiff_t)r->field.width * (ptrdiff_t)sizeof(float[3]),
        };
    r->targets = (dpl_targets){outputs[0], outputs[1], outputs[2]};
    return DPL_OK;
}

/* What is worked in on the way there and back. */
static dpl_status hold_work(dpl_hrc_resolution *r, const dpl_field *field) {
    dpl_context *context = r->field.context;
    bool finer = r->kind == DPL_RESOLUTION_DOUBLE;
    size_t workers = (size_t)dpl_jobs_worker_count(context->jobs);
    if (!finer) {
        size_t floats = (size_t)dpl_hrc_plane_count(r) * (size_t)dpl_hrc_plane_stride(r);
        DPL_TRY(hold(r, DPL_MEMORY_BLOCKS, 1));
        DPL_TRY(hold(r, DPL_MEMORY_MENDS, 1));
        DPL_TRY(dpl_buffer_reserve(context, &r->memory[DPL_MEMORY_PLANES], (size_t)r->field.height,
                                   floats * sizeof(float)));
    }
    return dpl_buffer_reserve(context, &r->memory[DPL_MEMORY_ROWS],
                              workers * (finer ? dpl_hrc_join_floats(r, field) : dpl_hrc_refine_floats(r)),
                              sizeof(float));
}

int64_t dpl_hrc_resolution_bytes(const dpl_hrc_resolution *r) {
    int64_t bytes = 0;
    for (int i = 0; i < DPL_MEMORIES; i++)
        bytes += (int64_t)r->memory[i].bytes;
    return bytes;
}

void dpl_hrc_resolution_free(dpl_context *context, dpl_hrc_resolution *r) {
    for (int i = 0; i < DPL_MEMORIES; i++)
        dpl_buffer_free(context, &r->memory[i]);
}

/* ---- frame ---------------------------------------------------------------------------------------- */

dpl_status dpl_hrc_scale_field(dpl_hrc_resolution *r, const dpl_field *field, const dpl_targets *targets) {
    size_field(r, field);
    DPL_TRY(hold_field(r, field));
    DPL_TRY(hold_targets(r, targets));
    DPL_TRY(hold_work(r, field));
    dpl_hrc_resampling task = {r, field, targets};
    if (r->kind == DPL_RESOLUTION_DOUBLE)
        return dpl_jobs_run(field->context, dpl_hrc_split_task, field->height, 8, &task);
    DPL_TRY(dpl_jobs_run(field->context, dpl_hrc_survey_task, r->field.height, 8, &task));
    return dpl_jobs_run(field->context, dpl_hrc_coarsen_task, r->field.height, 8, &task);
}

/* Without the progress hook: the caller's targets are written whole or not at all. */
dpl_status dpl_hrc_scale_light(dpl_hrc_resolution *r, const dpl_field *field, const dpl_targets *targets) {
    dpl_hrc_resampling task = {r, field, targets};
    int32_t height = dpl_field_picture_height(field);
    if (r->kind == DPL_RESOLUTION_DOUBLE)
        return dpl_jobs_run(field->context, dpl_hrc_join_task, height, 8, &task);
    DPL_TRY(dpl_jobs_run(field->context, dpl_hrc_weigh_task, r->field.height, 8, &task));
    return dpl_jobs_run(field->context, dpl_hrc_refine_task, height, 8, &task);
}

/* Directions inside opaque pixels are 0. */
static void clear_opaque(const dpl_field *field, int32_t y, float *plane) {
    const uint8_t *kind = (const uint8_t *)field->kind.data + dpl_field_cell(field, 0, y);
    for (int32_t x = 0; x < field->width; x++)
        plane[x] = kind[x] == DPL_PIXEL_OPAQUE ? 0.0f : plane[x];
}

void dpl_hrc_write_targets(const dpl_hrc_resampling *task, int32_t y, float *const planes[]) {
    const dpl_output *outputs[DPL_HRC_TARGETS] = {&task->targets->mean, &task->targets->cosine,
                                                  &task->targets->sine};
    bool reflects = task->resolution->reflects;
    if (reflects)
        dpl_hrc_show_walls(task, y, planes);
    for (int32_t target = 0; target < task->resolution->target_count; target++) {
        const float *channels[3];
        for (int32_t c = 0; c < 3; c++) {
            if (target > 0)
                clear_opaque(task->field, y, planes[target * 3 + c]);
            channels[c] = planes[target * 3 + c];
        }
        dpl_solver_write_row(task->field, outputs[target], y, channels, target == 0 && !reflects);
    }
}
