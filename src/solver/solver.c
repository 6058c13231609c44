/* Progress, counters and output, the same for every method. */
#include "solver/solver.h"

#include "base/layout.h"
#include "job/jobs.h"

/* Pieces between two calls of the progress hook, of a whole solve. */
#define PROGRESS_STEPS 200

/* Pixels that are put together at a time before they are stored: a few KiB of stack. */
#define RUN 128

/* Pictures that take more are written past the caches: who reads them will not find them there, and to fetch
 * what is written over costs as much as to write it [byte]. */
#define MOST_CACHED ((size_t)8 << 20)

int64_t dpl_ray_counter_sum(const dpl_ray_counter counters[DPL_MAX_THREADS]) {
    int64_t sum = 0;
    for (int i = 0; i < DPL_MAX_THREADS; i++)
        sum += counters[i].rays;
    return sum;
}

dpl_status dpl_solver_progress(dpl_solver *solver, double done) {
    if (!solver->desc.progress || solver->desc.progress(done, solver->desc.progress_user))
        return DPL_OK;
    return dpl_fail(solver->context, DPL_ERROR_CANCELLED, "cancelled at %.0f %%", 100.0 * done);
}

/* Work is cut by shifting the items that a task sees. */
typedef struct shifted_task {
    dpl_task_function function;
    void *task;
    int32_t first;
} shifted_task;

static void run_shifted(int32_t begin, int32_t end, int32_t worker, void *task) {
    const shifted_task *s = task;
    s->function(begin + s->first, end + s->first, worker, s->task);
}

dpl_status dpl_solver_run(dpl_solver *solver, dpl_task_function function, int32_t item_count,
                          int32_t min_range, void *task, double done_before, double done_after) {
    if (!solver->desc.progress)
        return dpl_jobs_run(solver->context, function, item_count, min_range, task);
    int32_t steps = (int32_t)((done_after - done_before) * PROGRESS_STEPS) + 1;
    int32_t step = item_count / steps + 1;
    for (int32_t first = 0; first < item_count; first += step) {
        shifted_task shifted = {function, task, first};
        int32_t count = item_count - first < step ? item_count - first : step;
        DPL_TRY(dpl_jobs_run(solver->context, run_shifted, count, min_range, &shifted));
        DPL_TRY(dpl_solver_progress(solver,
                                    done_before + (done_after - done_before) * (first + count) / item_count));
    }
    return DPL_OK;
}

/* Stores channels as they are in the output's format. */
static void store_channels(const dpl_kernels *kernels, dpl_format format, char *to, const float *from,
                           int32_t count) {
    if (format == DPL_FORMAT_F16)
        kernels->half_from_float(count, (uint16_t *)(void *)to, from);
    else
        memcpy(to, from, (size_t)count * sizeof *from);
}

void dpl_solver_write_pixels(const dpl_field *field, const dpl_output *output, int32_t x, int32_t y,
                             int32_t count, const float (*rgb)[3]) {
    size_t pixel_bytes = (size_t)output->channels * dpl_format_bytes(output->format);
    char *to = (char *)output->data + output->row_stride * y + pixel_bytes * (size_t)x;
    if (output->channels == 3) {
        store_channels(field->context->kernels, output->format, to, rgb[0], 3 * count);
        return;
    }
    float rgba[RUN][4];
    for (int32_t first = 0; first < count; first += RUN, to += RUN * pixel_bytes) {
        int32_t pixels = count - first < RUN ? count - first : RUN;
        for (int32_t i = 0; i < pixels; i++) {
            memcpy(rgba[i], rgb[first + i], sizeof *rgb);
            rgba[i][3] = 1.0f;
        }
        store_channels(field->context->kernels, output->format, to, rgba[0], 4 * pixels);
    }
}

typedef struct picture_task {
    const dpl_field *field;
    const dpl_output *output;
    const float (*picture)[3];
} picture_task;

/* Items are rows. */
static void write_picture_rows(int32_t begin, int32_t end, int32_t worker, void *task) {
    (void)worker;
    const picture_task *t = task;
    int32_t width = t->output->width;
    for (int32_t y = begin; y < end; y++)
        dpl_solver_write_pixels(t->field, t->output, 0, y, width, t->picture + (size_t)y * (size_t)width);
}

dpl_status dpl_solver_write_picture(const dpl_field *field, const dpl_output *output,
                                    const float (*picture)[3]) {
    picture_task task = {field, output, picture};
    return dpl_jobs_run(field->context, write_picture_rows, output->height, 32, &task);
}

/* Opaque pixels get their emission. */
static void show_opaque(int32_t count, float (*rgb)[3], const uint8_t *kind, const float (*emission)[4]) {
    const uint8_t *at = memchr(kind, DPL_PIXEL_OPAQUE, (size_t)count);
    for (ptrdiff_t i = at ? at - kind : count; i < count; i++)
        if (kind[i] == DPL_PIXEL_OPAQUE)
            memcpy(rgb[i], emission[i], sizeof *rgb);
}

void dpl_solver_write_row(const dpl_field *field, const dpl_output *output, int32_t y,
                          const float *const planes[3], bool show_emission) {
    size_t row = dpl_field_cell(field, field->margin, y);
    const uint8_t *kind = (const uint8_t *)field->kind.data + row;
    const float(*emission)[4] = (const float(*)[4])field->emission.data + row;
    int32_t width = dpl_field_picture_width(field), top = y - field->margin;
    bool as_is = output->channels == 3 && output->format == DPL_FORMAT_F32;
    float(*to)[3] = as_is ? (float(*)[3])(void *)((char *)output->data + output->row_stride * top) : NULL;
    if (as_is && !show_emission) {
        const float *const from[3] = {planes[0] + field->margin, planes[1] + field->margin,
                                      planes[2] + field->margin};
        bool streams = sizeof *to * (size_t)width > MOST_CACHED / (size_t)output->height;
        field->context->kernels->interleave(width, to, from, streams);
        return;
    }
    float room[RUN][3];
    for (int32_t first = 0; first < width; first += RUN) {
        int32_t pixels = width - first < RUN ? width - first : RUN, x = field->margin + first;
        float(*rgb)[3] = as_is ? to + first : room;
        const float *const from[3] = {planes[0] + x, planes[1] + x, planes[2] + x};
        field->context->kernels->interleave(pixels, rgb, from, false);
        if (show_emission)
            show_opaque(pixels, rgb, kind + first, emission + first);
        if (!as_is)
            dpl_solver_write_pixels(field, output, first, top, pixels, (const float(*)[3])rgb);
    }
}
