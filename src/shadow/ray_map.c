/* Makes a ray map by drawing opaque pixels into it, each over the directions in which it is met, see
 * ray_map.h.
 */
#include "shadow/ray_map.h"

#include "job/jobs.h"

#include <math.h>

#define PI 3.14159265358979323846
/* Bins are no wider than this at the far end of the picture [px]. */
#define WIDEST_BIN 1.0
#define MOST_BINS 16384
/* Rays drawn at once: one item of work. */
#define BATCH 16
/* Pixels are drawn this much larger, so that no ray slips through where two meet [px]. */
#define OVERLAP 1e-3f

typedef struct drawing {
    const dpl_solid *solid;
    float *data;
    const float *offsets;
    int32_t rays, bins;
    float x, y, radius; /* of the light */
} drawing;

/* Directions from `first` on, `count` of them, in which a ray of each offset meets a pixel. */
typedef struct stretch {
    int32_t first[BATCH], end[BATCH];
} stretch;

/* A pixel's centre at (x, y) from the light's: ray k passes the square as long as the centre is nearer to it
 * than half the square's width across the ray. */
static void find_stretch(const drawing *d, int32_t begin, int32_t count, float x, float y, stretch *out) {
    float square = x * x + y * y, angle = atan2f(y, x), per_angle = (float)(d->bins / (2.0 * PI));
    for (int32_t i = 0; i < count; i++) {
        float p = d->offsets[begin + i] * d->radius, along = sqrtf(fmaxf(square - p * p, 0.25f));
        float ux = along * x + p * y, uy = along * y - p * x;
        float half = (0.5f + OVERLAP) * (fabsf(ux) + fabsf(uy)) / (square * along);
        float middle = angle - atan2f(p, along);
        out->first[i] = (int32_t)((middle - half) * per_angle + 0.5f + (float)(2 * d->bins));
        out->end[i] = (int32_t)((middle + half) * per_angle + 0.5f + (float)(2 * d->bins));
    }
}

static void draw_pixel(const drawing *d, int32_t begin, int32_t count, float x, float y) {
    float square = x * x + y * y;
    int32_t mask = d->bins - 1;
    stretch s;
    if (square <= d->radius * d->radius)
        return;
    find_stretch(d, begin, count, x, y, &s);
    for (int32_t i = 0; i < count; i++) {
        float *reach = d->data + (size_t)(begin + i) * (size_t)d->bins;
        for (int32_t bin = s.first[i]; bin < s.end[i]; bin++)
            reach[bin & mask] = reach[bin & mask] < square ? reach[bin & mask] : square;
    }
}

/* Opaque pixels of a word of row y that have a free side towards some point of the light: a ray meets one of
 * them before any other. */
static uint64_t exposed_bits(const drawing *d, int32_t y, int32_t word) {
    const dpl_solid *solid = d->solid;
    const uint64_t *row = (const uint64_t *)solid->rows.data + (size_t)y * (size_t)solid->row_words + word;
    uint64_t own = row[0], exposed = 0;
    float x = (float)word * 64.0f;
    if (!own)
        return 0;
    if (d->y - d->radius < (float)y)
        exposed |= y > 0 ? ~row[-solid->row_words] : ~(uint64_t)0;
    if (d->y + d->radius > (float)y + 1.0f)
        exposed |= y + 1 < solid->height ? ~row[solid->row_words] : ~(uint64_t)0;
    if (d->x - d->radius < x + 64.0f)
        exposed |= ~(own << 1 | (word > 0 ? row[-1] >> 63 : 0));
    if (d->x + d->radius > x)
        exposed |= ~(own >> 1 | row[1] << 63);
    return own & exposed;
}

static void draw_rays(int32_t begin, int32_t end, int32_t worker, void *task) {
    (void)worker;
    const drawing *d = task;
    int32_t words = (d->solid->width + 63) / 64;
    for (int32_t batch = begin; batch < end; batch++) {
        int32_t first = batch * BATCH, count = d->rays - first < BATCH ? d->rays - first : BATCH;
        float *reach = d->data + (size_t)first * (size_t)d->bins;
        for (size_t i = 0; i < (size_t)count * (size_t)d->bins; i++)
            reach[i] = INFINITY;
        for (int32_t y = 0; y < d->solid->height; y++)
            for (int32_t word = 0; word < words; word++)
                for (uint64_t bits = exposed_bits(d, y, word); bits; bits &= bits - 1)
                    draw_pixel(d, first, count, (float)(word * 64 + dpl_lowest_bit(bits)) + 0.5f - d->x,
                               (float)y + 0.5f - d->y);
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
    DPL_TRY(dpl_buffer_reserve(context, &table->reach, (size_t)rays * (size_t)bins, sizeof(float)));
    DPL_TRY(dpl_buffer_reserve(context, &table->offsets, (size_t)rays, sizeof(float)));
    float *offsets = table->offsets.data;
    for (int32_t k = 0; k < rays; k++)
        offsets[k] = (float)((2.0 * k + 1.0) / rays - 1.0);
    drawing d = {.solid = solid,
                 .data = table->reach.data,
                 .offsets = offsets,
                 .rays = rays,
                 .bins = bins,
                 .x = (float)position[0],
                 .y = (float)position[1],
                 .radius = (float)radius};
    DPL_TRY(dpl_jobs_run(context, draw_rays, (rays + BATCH - 1) / BATCH, 1, &d));
    table->map = (dpl_ray_map){rays, bins, (float)radius, offsets, table->reach.data};
    return DPL_OK;
}

void dpl_ray_table_free(dpl_context *context, dpl_ray_table *table) {
    dpl_buffer_free(context, &table->reach);
    dpl_buffer_free(context, &table->offsets);
}
