/* Cases of the kernels of disc lights. */
#include "kernel/cases.h"

#include <math.h>

enum { DRAWN = 16 };

static void look_round(const dpl_kernel_case *c, const dpl_kernels *kernels, const dpl_case_inputs *in,
                       void *out) {
    const dpl_horizon_table table = {in->bins, DPL_CASE_BINS};
    (void)c;
    kernels->look_round(&table, DPL_CASE_ROW, out, -200.0f, 77.0f);
}

/* Sixteen pixels into all rays: a piece of a wall. */
static void draw_rays(const dpl_kernel_case *c, const dpl_kernels *kernels, const dpl_case_inputs *in,
                      void *out) {
    const dpl_ray_map map = {DPL_CASE_MAP_RAYS, DPL_CASE_BINS, 6.0f, in->offsets, out};
    (void)c;
    kernels->draw_rays(&map, 0, DPL_CASE_MAP_RAYS, DRAWN, in->receivers[0] + 150, 40.0f);
}

/* The map is only read. */
static void see_rays(const dpl_kernel_case *c, const dpl_kernels *kernels, const dpl_case_inputs *in,
                     void *out) {
    const dpl_ray_map map = {DPL_CASE_MAP_RAYS, DPL_CASE_BINS, 6.0f, in->offsets,
                             (float *)(uintptr_t)in->reach};
    (void)c;
    kernels->see_rays(&map, DPL_CASE_ROW, out, in->receivers[0], in->receivers[1]);
}

static void fill_far(void *out) {
    for (size_t i = 0; i < DPL_CASE_OUT / sizeof(float); i++)
        ((float *)out)[i] = INFINITY;
}

static const dpl_kernel_case cases[] = {
    {"look_round", "row", .item = "pixel", .items = DPL_CASE_ROW, .out_bytes = DPL_CASE_ROW,
     .run = look_round},
    {"draw_rays", "16 pixels, 56 rays", .item = "pixel", .items = DRAWN, .out_bytes = DPL_CASE_OUT,
     .run = draw_rays, .fill = fill_far},
    {"see_rays", "row, 56 rays", .item = "pixel", .items = DPL_CASE_ROW,
     .out_bytes = DPL_CASE_ROW * sizeof(float), .run = see_rays},
};

const dpl_kernel_case *dpl_cases_of_lights(int32_t *count) {
    *count = sizeof cases / sizeof cases[0];
    return cases;
}
