/* How far two pictures are apart. Called by web/module/core.js. */
#ifndef DPL_WEB_COMPARE_H
#define DPL_WEB_COMPARE_H

#include "session.h"

/* Judges the emission plane by the extinction plane, as they stand in the session; `mask` may be NULL, else
 * shape [height][width], 1 where a pixel is left out. `values` receives psnr_linear, psnr_display, rel_rmse,
 * ssim, flip and the number of pixels. */
int32_t dpl_web_compare(dpl_web_session *session, const uint8_t *mask, double values[6]);

#endif
