/* The scalar reference of the kernel `classify`: ref.c puts it into its table. */
#ifndef DPL_KERNEL_DEPTH_REF_H
#define DPL_KERNEL_DEPTH_REF_H

#include "kernel/depth_view.h"

/* As dpl_kernels.classify. */
void dpl_classify_ref(const dpl_depth_view *view, dpl_depth_receivers *receivers);

#endif
