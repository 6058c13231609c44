/* dpl_tonemap(): checks, then rows in parallel through the kernel. Called by the user. */
#include <dapple/tonemap.h>

#include "job/jobs.h"
#include "metric/display.h"
#include "metric/view.h"

typedef struct tonemap_work {
    const dpl_kernels *kernels;
    const dpl_pixels *linear;
    uint8_t *rgb;
    ptrdiff_t row_stride;
} tonemap_work;

static void tonemap_rows(int32_t begin, int32_t end, int32_t worker, void *task) {
    (void)worker;
    const tonemap_work *work = task;
    for (int32_t y = begin; y < end; y++)
        dpl_tonemap_row(work->kernels, dpl_view_row(work->linear, y), work->linear->channels,
                        work->linear->width, work->rgb + y * work->row_stride);
}

dpl_status dpl_tonemap(dpl_context *context, const dpl_pixels *linear, uint8_t *rgb, ptrdiff_t row_stride) {
    if (!context)
        return DPL_ERROR_ARGUMENT;
    if (!linear || !rgb)
        return dpl_fail(context, DPL_ERROR_ARGUMENT, "linear or rgb is NULL");
    DPL_TRY(dpl_view_check(context, "linear picture", linear, DPL_ERROR_ARGUMENT));
    const ptrdiff_t tight = (ptrdiff_t)linear->width * 3;
    const ptrdiff_t stride = dpl_stride_or_tight(row_stride, tight);
    if (!dpl_stride_holds(stride, tight))
        return dpl_fail(context, DPL_ERROR_ARGUMENT, "row_stride %td is shorter than a row of %td bytes",
                        stride, tight);
    tonemap_work work = {context->kernels, linear, rgb, stride};
    return dpl_jobs_run(context, tonemap_rows, linear->height, 1, &work);
}
