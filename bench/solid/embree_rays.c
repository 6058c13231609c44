/* Embree on the receivers of bench_solid, see embree_rays.h. */
#include "embree_rays.h"

#include <math.h>

/* Points of the grid along a side. */
#define GRID 24

/* Rays start this far above the receiver [scene unit], and end before the light. */
#define ABOVE 3e-4f
#define BEFORE_LIGHT 0.9999f

dpl_bench_sampling dpl_bench_sampling_grid(void) {
    dpl_bench_sampling s = {.count = GRID * GRID};
    for (int i = 0; i < GRID * GRID; i++) {
        double radius = sqrt((i / GRID + 0.5) / GRID);
        double angle = 2.0 * 3.14159265358979323846 * (i % GRID + 0.5 * (i / GRID % 2)) / GRID;
        s.at[i][0] = (float)(radius * cos(angle));
        s.at[i][1] = (float)(radius * sin(angle));
    }
    return s;
}

dpl_bench_sampling dpl_bench_sampling_spiral(int32_t count) {
    dpl_bench_sampling s = {.count = count};
    for (int i = 0; i < count; i++) {
        double radius = sqrt((i + 0.5) / count), angle = 2.39996322972865332 * i;
        s.at[i][0] = (float)(radius * cos(angle));
        s.at[i][1] = (float)(radius * sin(angle));
    }
    return s;
}

/* Two directions across the way to the light, as long as its radius. The light is above, never along z. */
static void across(const float toward[3], float radius, float right[3], float up[3]) {
    float level = sqrtf(toward[0] * toward[0] + toward[1] * toward[1]);
    float length = sqrtf(level * level + toward[2] * toward[2]);
    right[0] = radius * toward[1] / level;
    right[1] = -radius * toward[0] / level;
    right[2] = 0.0f;
    for (int axis = 0; axis < 3; axis++) {
        int next = (axis + 1) % 3, last = (axis + 2) % 3;
        up[axis] = (toward[next] * right[last] - toward[last] * right[next]) / length;
    }
}

static void aim(const dpl_bench_sampling *sampling, const dpl_solid_light *light, const float from[3],
                dpl_ray *rays) {
    float toward[3], right[3], up[3];
    for (int axis = 0; axis < 3; axis++)
        toward[axis] = light->position[axis] - from[axis];
    across(toward, light->radius, right, up);
    for (int32_t i = 0; i < sampling->count; i++) {
        const float *at = sampling->at[i];
        rays[i].near = 0.0f;
        rays[i].far = BEFORE_LIGHT;
        for (int axis = 0; axis < 3; axis++) {
            rays[i].origin[axis] = from[axis] + (axis == 1 ? ABOVE : 0.0f);
            rays[i].direction[axis] = toward[axis] + at[0] * right[axis] + at[1] * up[axis];
        }
    }
}

void dpl_bench_embree_see(dpl_bench_embree *embree, const dpl_bench_sampling *sampling,
                          const dpl_solid_light *light, const float (*positions)[3], int32_t count,
                          float *visibility) {
    dpl_ray rays[DPL_BENCH_MOST_POINTS];
    uint8_t occluded[DPL_BENCH_MOST_POINTS];
    for (int32_t i = 0; i < count; i++) {
        int32_t open = 0;
        aim(sampling, light, positions[i], rays);
        for (int32_t k = 0; k < sampling->count && sampling->packets; k += 16)
            dpl_bench_embree_occluded_16(embree, rays + k, occluded + k);
        if (!sampling->packets)
            dpl_bench_embree_occluded(embree, rays, sampling->count, occluded);
        for (int32_t k = 0; k < sampling->count; k++)
            open += !occluded[k];
        visibility[i] = (float)open / (float)sampling->count;
    }
}
