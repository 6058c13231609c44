/* Progress, counters and output, the same for every method. */
#include "solver/solver.h"

#include "job/jobs.h"

/* Pieces between two calls of the progress hook, of a whole solve. */
#define PROGRESS_STEPS 200

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

void dpl_solver_write_row(const dpl_field *field, const dpl_output *output, int32_t y,
                          const float *const planes[3], bool show_emission) {
    float *out = (float *)(void *)((char *)output->data + output->row_stride * (y - field->margin));
    size_t row = dpl_field_cell(field, 0, y);
    const uint8_t *kind = (const uint8_t *)field->kind.data + row;
    const float(*emission)[4] = (const float(*)[4])field->emission.data + row;
    for (int32_t x = field->margin; x < field->width - field->margin; x++, out += output->channels) {
        bool opaque = show_emission && kind[x] == DPL_PIXEL_OPAQUE;
        for (int c = 0; c < 3; c++)
            out[c] = opaque ? emission[x][c] : planes[c][x];
        if (output->channels == 4)
            out[3] = 1.0f;
    }
}
