/* Makes a ray map by drawing opaque pixels into it, each over the directions in which it is met, see
 * ray_map.h.
 */
#include "shadow/ray_map.h"

#include "job/jobs.h"

#include <math.h>

#define PI 3.14159265358979323846
/* Bins are no wider than this at the far end of the picture [px]. */
#define WIDEST_BIN 0.5
#define MOST_BINS 16384
/* Rays drawn at once: one item of work. */
#define BATCH 32

typedef struct drawing {
    const dpl_kernels *kernels;
    const dpl_solid *solid;
    dpl_ray_map map;
    double position[2]; /* of the light */
} drawing;

/* Of a word's pixels, those outside the disc. */
static void draw_bits(const drawing *d, int32_t first, int32_t rays, uint64_t bits, int32_t y, int32_t word) {
    float x[64], down = (float)(y + 0.5 - d->position[1]);
    int32_t count = 0;
    for (; bits; bits &= bits - 1) {
        x[count] = (float)(word * 64 + dpl_lowest_bit(bits) + 0.5 - d->position[0]);
        count += x[count] * x[count] + down * down > d->map.radius * d->map.radius;
    }
    d->kernels->draw_rays(&d->map, first, rays, count, x, down);
}

static void draw_batches(int32_t begin, int32_t end, int32_t worker, void *task) {
    (void)worker;
    const drawing *d = task;
    int32_t words = (d->solid->width + 63) / 64;
    for (int32_t batch = begin; batch < end; batch++) {
        int32_t first = batch * BATCH, rays = d->map.rays - first < BATCH ? d->map.rays - first : BATCH;
        float *reach = d->map.reach + (size_t)first * (size_t)d->map.bins;
        for (size_t i = 0; i < (size_t)rays * (size_t)d->map.bins; i++)
            reach[i] = INFINITY;
        for (int32_t y = 0; y < d->solid->height; y++)
            for (int32_t word = 0; word < words; word++) {
                uint64_t bits = dpl_solid_exposed(d->solid, y, word, d->position, (double)d->map.radius);
                if (bits)
                    draw_bits(d, first, rays, bits, y, word);
            }
    }
}

/* Number of bins, or 0: the light is too far away. */
static int32_t bins_for(const dpl_solid *solid, const double position[2]) {
    double x = fmax(fabs(position[0]), fabs(position[0] - solid->width));
    double y = fmax(fabs(position[1]), fabs(position[1] - solid->height));
    for (int32_t bins = 1024; bins <= MOST_BINS; bins *= 2)
        if (2.0 * PI * sqrt(x * x + y * y) <= WIDEST_BIN * bins)
            return bins;
    return 0;
}

dpl_status dpl_ray_table_make(dpl_ray_table *table, dpl_context *context, const dpl_solid *solid,
                              const double position[2], double radius, int32_t rays) {
    int32_t bins = radius > 0.0 ? bins_for(solid, position) : 0;
    table->map.rays = 0;
    if (bins == 0)
        return DPL_OK;
    rays += rays % 2;
    DPL_TRY(dpl_buffer_reserve(context, &table->reach, (size_t)rays * (size_t)bins, sizeof(float)));
    DPL_TRY(dpl_buffer_reserve(context, &table->offsets, (size_t)rays, sizeof(float)));
    float *offsets = table->offsets.data;
    for (int32_t k = 0; k < rays; k++)
        offsets[k] = (float)((2.0 * k + 1.0) / rays - 1.0);
    drawing d = {context->kernels,
                 solid,
                 {rays, bins, (float)radius, offsets, table->reach.data},
                 {position[0], position[1]}};
    DPL_TRY(dpl_jobs_run(context, draw_batches, (rays + BATCH - 1) / BATCH, 1, &d));
    table->map = d.map;
    return DPL_OK;
}

void dpl_ray_table_free(dpl_context *context, dpl_ray_table *table) {
    dpl_buffer_free(context, &table->reach);
    dpl_buffer_free(context, &table->offsets);
}
