/* Sums over rows in a fixed order. Called by every metric. */
#include "metric/rows.h"

#include "job/jobs.h"

typedef double row_sums[DPL_ROW_SUMS];

typedef struct row_work {
    dpl_row_function function;
    const void *task;
    row_sums *sums; /* of each row */
} row_work;

static void run_rows(int32_t begin, int32_t end, int32_t worker, void *task) {
    const row_work *work = task;
    for (int32_t y = begin; y < end; y++) {
        row_sums sums = {0.0};
        work->function(y, worker, work->task, sums);
        memcpy(work->sums[y], sums, sizeof sums);
    }
}

dpl_status dpl_rows_sum(dpl_context *context, int32_t height, dpl_row_function function, const void *task,
                        double sums[DPL_ROW_SUMS]) {
    row_work work = {.function = function, .task = task};
    work.sums = dpl_allocate(context, (size_t)height, sizeof *work.sums);
    if (!work.sums)
        return DPL_ERROR_MEMORY;
    dpl_status status = dpl_jobs_run(context, run_rows, height, 1, &work);
    for (int32_t i = 0; i < DPL_ROW_SUMS; i++) {
        sums[i] = 0.0;
        for (int32_t y = 0; y < height && status == DPL_OK; y++)
            sums[i] += work.sums[y][i];
    }
    dpl_release(context, work.sums, (size_t)height, sizeof *work.sums);
    return status;
}
