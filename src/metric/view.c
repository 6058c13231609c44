/* Checks and rows of float pictures. Called by compare.c, pair.c and dpl_tonemap(). */
#include "metric/view.h"

#include <dapple/field.h>
#include <stdalign.h>

ptrdiff_t dpl_stride_or_tight(ptrdiff_t stride, ptrdiff_t tight) {
    return stride == 0 ? tight : stride;
}

bool dpl_stride_holds(ptrdiff_t stride, ptrdiff_t tight) {
    return stride >= tight || stride <= -tight;
}

static ptrdiff_t tight_bytes(const dpl_pixels *pixels) {
    return (ptrdiff_t)pixels->width * pixels->channels * (ptrdiff_t)sizeof(float);
}

static dpl_status check_layout(dpl_context *context, const char *name, const dpl_pixels *pixels) {
    const ptrdiff_t stride = dpl_stride_or_tight(pixels->row_stride, tight_bytes(pixels));
    if (!dpl_stride_holds(stride, tight_bytes(pixels)))
        return dpl_fail(context, DPL_ERROR_ARGUMENT, "%s: row_stride %td is shorter than a row of %td bytes",
                        name, stride, tight_bytes(pixels));
    if (stride % (ptrdiff_t)alignof(float) != 0 || (uintptr_t)pixels->data % alignof(float) != 0)
        return dpl_fail(context, DPL_ERROR_ARGUMENT, "%s: data or row_stride is not aligned to floats", name);
    return DPL_OK;
}

dpl_status dpl_view_check(dpl_context *context, const char *name, const dpl_pixels *pixels,
                          dpl_status size_status) {
    if (!pixels->data)
        return dpl_fail(context, DPL_ERROR_ARGUMENT, "%s: data is NULL", name);
    if (pixels->format != DPL_FORMAT_F32)
        return dpl_fail(context, DPL_ERROR_ARGUMENT, "%s: format is %d, not DPL_FORMAT_F32", name,
                        (int)pixels->format);
    if (pixels->channels != 3 && pixels->channels != 4)
        return dpl_fail(context, DPL_ERROR_ARGUMENT, "%s: %d channels, not 3 or 4", name, pixels->channels);
    if (pixels->width < 1 || pixels->width > DPL_MAX_SIZE || pixels->height < 1 ||
        pixels->height > DPL_MAX_SIZE)
        return dpl_fail(context, size_status, "%s: size %d x %d is not within 1 .. %d", name, pixels->width,
                        pixels->height, DPL_MAX_SIZE);
    return check_layout(context, name, pixels);
}

const float *dpl_view_row(const dpl_pixels *pixels, int32_t y) {
    const unsigned char *bytes = pixels->data;
    const ptrdiff_t stride = dpl_stride_or_tight(pixels->row_stride, tight_bytes(pixels));
    return (const float *)(const void *)(bytes + y * stride);
}
