/* The scalar reference of the kernels for a light's rays: ref.c puts them into its table, and kernel.h says
 * what each does. */
#ifndef DPL_KERNEL_LIGHT_REF_H
#define DPL_KERNEL_LIGHT_REF_H

#include "kernel/kernel.h"

void dpl_look_round_ref(const dpl_horizon_table *table, int32_t count, uint8_t *class, float dx, float dy);
void dpl_draw_rays_ref(const dpl_ray_map *map, int32_t first, int32_t rays, int32_t count, const float *x,
                       float y);
void dpl_see_rays_ref(const dpl_ray_map *map, int32_t count, float *visible, const float *dx,
                      const float *dy);

#endif
