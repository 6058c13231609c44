/* The scalar reference of the kernels `aim` and `list_hits`: ref.c puts it into its table, and instruction
 * sets that have nothing better use it too. */
#ifndef DPL_KERNEL_RAY_WORDS_REF_H
#define DPL_KERNEL_RAY_WORDS_REF_H

#include "kernel/ray_words.h"

/* As dpl_kernels.aim. */
int32_t dpl_aim_ref(const dpl_ray_axis *axis, int32_t count, const dpl_ray_word *words, float *const ends[4]);

/* As dpl_kernels.list_hits. */
int32_t dpl_list_hits_ref(int32_t count, dpl_ray_word *words, const int32_t *cell, int32_t *list);

#endif
