/* From the probes of level 0 to pixels. Called by cascades.c after the last level. */
#ifndef DPL_CASCADE_PIXELS_H
#define DPL_CASCADE_PIXELS_H

#include "solver/solver.h"

#include <dapple/schedule.h>

/* Radiance of level 0, stored as in level.h. */
typedef struct dpl_probe_plane {
    const dpl_schedule_level *plan;
    const float *radiance;
} dpl_probe_plane;

/* Writes the mean over all directions at every pixel, interpolated bilinearly between probes. `rows` is
 * scratch: three rows of pixels per worker. */
DPL_MUST_CHECK dpl_status dpl_probes_to_pixels(dpl_context *context, const dpl_probe_plane *probes,
                                               const dpl_field *field, const dpl_output *output, float *rows);

/* The same as the ARC paper's page shows it: plain bilinear, and within three pixels of a shape blended
 * towards the emission of that shape. The field keeps distances to shapes. */
DPL_MUST_CHECK dpl_status dpl_probes_to_blended_pixels(dpl_context *context, const dpl_probe_plane *probes,
                                                       const dpl_field *field, const dpl_output *output,
                                                       float *rows);

#endif
