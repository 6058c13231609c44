/* See output_fault.h. */
#include "api/output_fault.h"

#include "base/layout.h"

static dpl_status check_format(dpl_context *context, const dpl_output_rules *rules,
                               const dpl_output *output) {
    if (output->channels != 3 && output->channels != 4)
        return dpl_fail(context, DPL_ERROR_ARGUMENT, "the output has %d channels, not 3 or 4",
                        output->channels);
    if (output->format == DPL_FORMAT_F32 || (rules->halves && output->format == DPL_FORMAT_F16))
        return DPL_OK;
    return dpl_fail(context, DPL_ERROR_ARGUMENT, "the output's format is %d, not DPL_FORMAT_F32%s",
                    (int)output->format, rules->halves ? " or DPL_FORMAT_F16" : "");
}

dpl_status dpl_output_check(dpl_context *context, const dpl_output_rules *rules, dpl_output *output) {
    if (!output->data)
        return dpl_fail(context, DPL_ERROR_ARGUMENT, "the output has no data");
    if (output->width != rules->width || output->height != rules->height)
        return dpl_fail(context, DPL_ERROR_SIZE, "the output is %d x %d, the %s %d x %d", output->width,
                        output->height, rules->owner, rules->width, rules->height);
    DPL_TRY(check_format(context, rules, output));
    ptrdiff_t packed =
        (ptrdiff_t)((size_t)output->width * (size_t)output->channels * dpl_format_bytes(output->format));
    if (output->row_stride == 0)
        output->row_stride = packed;
    if (output->row_stride < packed && -output->row_stride < packed)
        return dpl_fail(context, DPL_ERROR_ARGUMENT, "the rows of the output overlap");
    if (!dpl_layout_is_aligned(output->data, output->row_stride, output->format))
        return dpl_fail(context, DPL_ERROR_ARGUMENT,
                        "the output's data or stride is not a multiple of a channel's %d bytes",
                        (int)dpl_format_bytes(output->format));
    return DPL_OK;
}
