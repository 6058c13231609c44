/* The scalar reference of the kernel `cover`: ref.c puts it into its table. */
#ifndef DPL_KERNEL_DISC_REF_H
#define DPL_KERNEL_DISC_REF_H

#include "kernel/disc.h"

/* As dpl_kernels.cover. */
bool dpl_cover_ref(const dpl_disc_view *view, const dpl_disc_points *points,
                   const dpl_disc_triangles *triangles, int32_t *covered);

#endif
