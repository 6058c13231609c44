/* What a frame does beside solving: pictures into a field, distances, light on colours; and the metrics.
 * Called through the table of workloads.c. */
#include "gate.h"

#include <stdlib.h>

/* Walls and lamps in blocks, a tenth of it fog; colours of every kind. */
static void fill(dpl_bench_gate_rig *rig) {
    float *drawn = rig->drawn.data, *light = rig->picture.data;
    for (int32_t i = 0; i < rig->drawn.width * rig->drawn.height; i++) {
        int32_t x = i % rig->drawn.width, y = i / rig->drawn.width;
        bool wall = (x / 19 + y / 17) % 5 == 0, fog = (x / 31 + y / 23) % 10 == 0;
        for (int32_t c = 0; c < 3; c++) {
            drawn[4 * i + c] = (float)((x * 7 + y * 3 + c) % 50) / 25.0f;
            light[4 * i + c] = (float)((x * 5 + y * 11 + 40 * c) % 64) / 40.0f;
        }
        drawn[4 * i + 3] = wall ? 1.0f : fog ? 0.1f : 0.0f;
        light[4 * i + 3] = 1.0f;
        for (int32_t c = 0; c < 4; c++)
            rig->bytes[4 * i + c] = (uint8_t)(x * 5 + y * 11 + 40 * c);
    }
}

bool dpl_bench_gate_prepare_pictures(const dpl_bench_gate_workload *workload, dpl_bench_gate_rig *rig,
                                     dpl_error *error) {
    int32_t size = workload->size;
    dpl_field_desc desc = dpl_field_desc_default();
    desc.width = desc.height = size;
    rig->bytes = malloc((size_t)size * (size_t)size * 4);
    if (!rig->bytes)
        return dpl_error_set(error, "%s", dpl_status_text(DPL_ERROR_MEMORY));
    if (!dpl_picture_create(&rig->picture, size, size, 4, error) ||
        !dpl_picture_create(&rig->drawn, size, size, 4, error))
        return false;
    fill(rig);
    return dpl_bench_gate_good(rig, dpl_field_create(rig->context, &desc, &rig->field), error) &&
           dpl_bench_gate_good(rig, dpl_bench_gate_draw_layer(rig), error);
}

dpl_status dpl_bench_gate_draw_layer(dpl_bench_gate_rig *rig) {
    dpl_layer layer = dpl_layer_default();
    layer.emission = layer.extinction = dpl_picture_pixels(&rig->drawn);
    return dpl_field_draw_layer(rig->field, &layer);
}

dpl_status dpl_bench_gate_read_distance(dpl_bench_gate_rig *rig) {
    return dpl_field_read_distance(rig->field, rig->picture.data, 0);
}

dpl_status dpl_bench_gate_apply_light(dpl_bench_gate_rig *rig) {
    int32_t width = rig->picture.width, height = rig->picture.height;
    const dpl_pixels light = dpl_picture_pixels(&rig->picture);
    const dpl_pixels albedo = {
        .data = rig->bytes, .format = DPL_FORMAT_SRGB8, .width = width, .height = height, .channels = 4};
    const dpl_output output = {
        .data = rig->bytes, .format = DPL_FORMAT_SRGB8, .width = width, .height = height, .channels = 4};
    return dpl_lightmap_apply(rig->context, &light, &albedo, NULL, &output);
}

dpl_status dpl_bench_gate_compare(dpl_bench_gate_rig *rig) {
    dpl_metrics_desc desc = dpl_metrics_desc_default();
    dpl_metrics metrics;
    desc.test = dpl_picture_pixels(&rig->picture);
    desc.reference = dpl_picture_pixels(&rig->drawn);
    return dpl_metrics_compare(rig->context, &desc, &metrics);
}
