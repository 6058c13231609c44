/* The scalar reference of the kernel `distance_along`, and the part of it that vectors fall back on. Used by
 * ref.c and vector_distance.h. */
#ifndef DPL_KERNEL_DISTANCE_REF_H
#define DPL_KERNEL_DISTANCE_REF_H

#include "kernel/distance.h"

/* As dpl_kernels.distance_along. */
void dpl_distance_along_ref(const dpl_distance_rows *rows, void *scratch);

/* Squared distances [px^2] of row y, by the lower envelope of its parabolas, in place of its clearances. */
void dpl_distance_envelope(const dpl_distance_rows *rows, int32_t y, void *scratch);

#endif
