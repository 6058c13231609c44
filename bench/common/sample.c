/* Draws pixels without putting any back. Called once per scene. */
#include "sample.h"

#include "../../scenes/random.h"

#include <dapple/status.h>
#include <stdlib.h>
#include <string.h>

/* Streams of random numbers from here on are for samples; scene families use others. */
#define FIRST_STREAM 0x73616d706c650000u

/* Numbers of all pixels that are not opaque: malloc'ed. */
static int32_t *list_free_pixels(const dpl_field *field, int32_t *count, dpl_error *error) {
    size_t pixels = (size_t)dpl_field_width(field) * (size_t)dpl_field_height(field);
    uint8_t *opaque = malloc(pixels);
    int32_t *list = malloc(pixels * sizeof *list);
    *count = 0;
    dpl_status status = opaque && list ? dpl_field_read_opaque(field, opaque, 0) : DPL_ERROR_MEMORY;
    for (size_t i = 0; status == DPL_OK && i < pixels; i++)
        if (!opaque[i])
            list[(*count)++] = (int32_t)i;
    free(opaque);
    if (status == DPL_OK && *count > 0)
        return list;
    dpl_error_set(error, "%s", status ? dpl_status_text(status) : "every pixel of the scene is opaque");
    free(list);
    return NULL;
}

bool dpl_bench_sample_draw(const dpl_field *field, int32_t count, uint64_t seed, int32_t scene,
                           dpl_bench_sample *sample, dpl_error *error) {
    int32_t available, width = dpl_field_width(field);
    memset(sample, 0, sizeof *sample);
    int32_t *list = list_free_pixels(field, &available, error);
    if (!list)
        return false;
    if (count > available)
        count = available;
    sample->pixels = malloc((size_t)count * sizeof *sample->pixels);
    if (!sample->pixels) {
        free(list);
        return dpl_error_set(error, "%s", dpl_status_text(DPL_ERROR_MEMORY));
    }
    sample->count = count;
    dpl_random random = dpl_random_start(seed, FIRST_STREAM + (uint64_t)scene);
    for (int32_t i = 0; i < count; i++) {
        int32_t chosen = i + dpl_random_below(&random, available - i);
        int32_t pixel = list[chosen];
        list[chosen] = list[i];
        sample->pixels[i][0] = pixel % width;
        sample->pixels[i][1] = pixel / width;
    }
    free(list);
    return true;
}

void dpl_bench_sample_free(dpl_bench_sample *sample) {
    free(sample->pixels);
    memset(sample, 0, sizeof *sample);
}

void dpl_bench_sample_read(const dpl_bench_sample *sample, const dpl_picture *picture, float (*rgb)[3]) {
    for (int32_t i = 0; i < sample->count; i++) {
        size_t pixel = (size_t)sample->pixels[i][1] * (size_t)picture->width + (size_t)sample->pixels[i][0];
        memcpy(rgb[i], picture->data + pixel * 3, sizeof rgb[i]);
    }
}

dpl_status dpl_bench_sample_compare(dpl_context *context, const float (*test)[3], const float (*truth)[3],
                                    int32_t count, dpl_metrics *metrics) {
    dpl_metrics_desc desc = dpl_metrics_desc_default();
    desc.test = (dpl_pixels){.data = test, .width = count, .height = 1, .channels = 3};
    desc.reference = desc.test;
    desc.reference.data = truth;
    return dpl_metrics_compare(context, &desc, metrics);
}
