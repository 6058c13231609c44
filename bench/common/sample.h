/* Pixels drawn by chance from those that are not opaque, and their colours in a picture. Used by benchmarks
 * that judge pictures by the truth at some pixels. */
#ifndef DPL_BENCH_SAMPLE_H
#define DPL_BENCH_SAMPLE_H

#include "../../image/picture.h"

#include <dapple/field.h>
#include <dapple/metric.h>

/* Most pixels of one sample: the width that a picture may have. */
#define DPL_BENCH_MAX_PIXELS DPL_PICTURE_MAX_SIZE

typedef struct dpl_bench_sample {
    int32_t count;
    int32_t (*pixels)[2]; /* shape [count][2]: x, y; no pixel twice */
} dpl_bench_sample;

/* Draws `count` free pixels, or all when there are fewer; which ones depends on the seed and the scene's
 * number alone. Free with dpl_bench_sample_free(). */
bool dpl_bench_sample_draw(const dpl_field *field, int32_t count, uint64_t seed, int32_t scene,
                           dpl_bench_sample *sample, dpl_error *error);

void dpl_bench_sample_free(dpl_bench_sample *sample);

/* The chosen pixels of an RGB picture side by side: rgb has shape [count][3]. */
void dpl_bench_sample_read(const dpl_bench_sample *sample, const dpl_picture *picture, float (*rgb)[3]);

/* The library's own metrics, over a picture of one row that holds the chosen pixels: both of shape
 * [count][3].
 */
dpl_status dpl_bench_sample_compare(dpl_context *context, const float (*test)[3], const float (*truth)[3],
                                    int32_t count, dpl_metrics *metrics);

#endif
