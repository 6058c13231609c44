/* The scalar reference of the kernels for runs before a disc: ref.c puts them into its table, and kernel.h
 * says what each does. */
#ifndef DPL_KERNEL_COVER_REF_H
#define DPL_KERNEL_COVER_REF_H

#include "kernel/kernel.h"

void dpl_face_disc_ref(dpl_receivers *receivers);
bool dpl_cover_runs_ref(dpl_receivers *receivers, const dpl_runs *runs, bool careful);
void dpl_share_seen_ref(const dpl_receivers *receivers, float *visible);

#endif
