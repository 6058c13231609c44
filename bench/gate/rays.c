/* Shadows of one light, and rays among shapes. Called through the table of workloads.c. */
#include "gate.h"

#include "../common/scatter.h"

enum { DISCS = 2000, DIRECTIONS = 16 };

bool dpl_bench_gate_prepare_shadow(const dpl_bench_gate_workload *workload, dpl_bench_gate_rig *rig,
                                   dpl_error *error) {
    dpl_shadow_desc desc = dpl_shadow_desc_default();
    int32_t size = workload->size;
    desc.method = workload->shadow;
    rig->light = (dpl_light){{0.4 * size, 0.55 * size}, 4, {1, 1, 1}, 1};
    return dpl_bench_world_make(workload->world, size, rig->context, &rig->field, error) &&
           dpl_picture_create(&rig->picture, size, size, 1, error) &&
           dpl_bench_gate_good(rig, dpl_shadow_create(rig->context, &desc, &rig->shadow), error);
}

dpl_status dpl_bench_gate_cast_shadow(dpl_bench_gate_rig *rig) {
    return dpl_shadow_visibility(rig->shadow, rig->field, &rig->light, rig->picture.data, 0);
}

bool dpl_bench_gate_prepare_tracer(const dpl_bench_gate_workload *workload, dpl_bench_gate_rig *rig,
                                   dpl_error *error) {
    rig->shape_count = DISCS;
    rig->shapes = dpl_bench_scatter_shapes(DPL_SHAPE_DISC, rig->shape_count, 1);
    if (!rig->shapes)
        return dpl_error_set(error, "%s", dpl_status_text(DPL_ERROR_MEMORY));
    return dpl_picture_create(&rig->picture, workload->size, workload->size, 3, error) &&
           dpl_bench_gate_good(rig, dpl_bench_gate_build(rig), error);
}

/* In a tracer of its own: a second set of as many shapes would only move boxes. */
dpl_status dpl_bench_gate_build(dpl_bench_gate_rig *rig) {
    dpl_tracer_destroy(rig->tracer);
    rig->tracer = NULL;
    dpl_tracer_desc desc = dpl_tracer_desc_default();
    dpl_status status = dpl_tracer_create(rig->context, &desc, &rig->tracer);
    if (status != DPL_OK)
        return status;
    return dpl_tracer_set_shapes(rig->tracer, DPL_TRACER_STATIC, rig->shapes, rig->shape_count);
}

dpl_status dpl_bench_gate_trace(dpl_bench_gate_rig *rig) {
    dpl_tracer_light_desc desc = dpl_tracer_light_desc_default();
    dpl_output output = dpl_picture_output(&rig->picture);
    desc.directions = DIRECTIONS;
    return dpl_tracer_light(rig->tracer, &desc, &output);
}
