/* The library's metrics behind plain numbers. */
#include "compare.h"

#include <dapple/metric.h>
#include <string.h>

int32_t dpl_web_compare(dpl_web_session *session, const uint8_t *mask, double values[6]) {
    dpl_metrics_desc desc = dpl_metrics_desc_default();
    dpl_metrics found;
    const dpl_pixels picture = {
        .format = DPL_FORMAT_F32, .width = session->width, .height = session->height, .channels = 3};
    desc.test = desc.reference = picture;
    desc.test.data = session->planes[DPL_WEB_EMISSION];
    desc.reference.data = session->planes[DPL_WEB_EXTINCTION];
    desc.mask = mask;
    dpl_status status = dpl_metrics_compare(session->context, &desc, &found);
    if (status != DPL_OK)
        return (int32_t)status;
    const double numbers[6] = {found.psnr_linear, found.psnr_display, found.rel_rmse,
                               found.ssim,        found.flip,         (double)found.pixels};
    memcpy(values, numbers, sizeof numbers);
    return DPL_OK;
}
