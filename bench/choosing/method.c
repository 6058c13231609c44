/* One prepare and one light for each kind of method. */
#include "method.h"

/* ---- solvers of the field ------------------------------------------------------------------------- */

static dpl_status prepare_cascades(dpl_bench_stand *stand, const dpl_bench_method *method) {
    dpl_solver_desc desc = dpl_solver_desc_default();
    desc.kind = DPL_SOLVER_CASCADES;
    desc.cascades.merge = (dpl_merge)method->variant;
    return dpl_solver_create(stand->context, &desc, &stand->solver);
}

static dpl_status prepare_holographic(dpl_bench_stand *stand, const dpl_bench_method *method) {
    dpl_solver_desc desc = dpl_solver_desc_default();
    desc.kind = DPL_SOLVER_HOLOGRAPHIC;
    desc.holographic.storage = (dpl_storage)method->variant;
    return dpl_solver_create(stand->context, &desc, &stand->solver);
}

static dpl_status light_solver(dpl_bench_stand *stand, const dpl_output *output) {
    return dpl_solver_solve(stand->solver, stand->field, output);
}

/* ---- rays against shapes -------------------------------------------------------------------------- */

static dpl_status prepare_tracer(dpl_bench_stand *stand, const dpl_bench_method *method) {
    dpl_tracer_desc desc = dpl_tracer_desc_default();
    desc.method = (dpl_tracer_method)method->variant;
    dpl_status status = dpl_tracer_create(stand->context, &desc, &stand->tracer);
    if (status != DPL_OK)
        return status;
    return dpl_tracer_set_shapes(stand->tracer, DPL_TRACER_STATIC, stand->scene.shapes,
                                 stand->scene.shape_count);
}

static dpl_status light_tracer(dpl_bench_stand *stand, const dpl_output *output) {
    dpl_tracer_light_desc desc = dpl_tracer_light_desc_default();
    desc.directions = stand->directions;
    for (int c = 0; c < 3; c++)
        desc.sky[c] = (float)stand->scene.sky[c];
    return dpl_tracer_light(stand->tracer, &desc, output);
}

/* ---- tiles ---------------------------------------------------------------------------------------- */

static dpl_status prepare_flood(dpl_bench_stand *stand, const dpl_bench_method *method) {
    const dpl_scene_flood_rules rules = {(dpl_flood_falloff)method->variant, stand->scene.width, false};
    return dpl_scene_build_flood(&stand->scene, stand->field, stand->context, &rules, &stand->flood);
}

static dpl_status light_flood(dpl_bench_stand *stand, const dpl_output *output) {
    dpl_status status = dpl_flood_solve(stand->flood.flood);
    return status == DPL_OK ? dpl_scene_read_flood(&stand->flood, output) : status;
}

/* ---- shadows of a disc ---------------------------------------------------------------------------- */

static dpl_status prepare_shadow(dpl_bench_stand *stand, const dpl_bench_method *method) {
    dpl_shadow_desc desc = dpl_shadow_desc_default();
    desc.method = (dpl_shadow_method)method->variant;
    return dpl_shadow_create(stand->context, &desc, &stand->shadow);
}

static dpl_status light_shadow(dpl_bench_stand *stand, const dpl_output *output) {
    return dpl_shadow_light(stand->shadow, stand->unlit, &stand->light, 1, output);
}

const dpl_bench_method dpl_bench_choosing_methods[DPL_BENCH_CHOOSING_METHODS] = {
    {"rays naive", DPL_TRACER_NAIVE, false, false, prepare_tracer, light_tracer},
    {"rays BVH", DPL_TRACER_BVH, false, false, prepare_tracer, light_tracer},
    {"flood fill", DPL_FLOOD_ROUND, false, true, prepare_flood, light_flood},
    {"cascades bilinear", DPL_MERGE_BILINEAR, false, false, prepare_cascades, light_solver},
    {"cascades bilinear-fix", DPL_MERGE_BILINEAR_FIX, false, false, prepare_cascades, light_solver},
    {"holographic float", DPL_STORAGE_FLOAT, false, false, prepare_holographic, light_solver},
    {"holographic half", DPL_STORAGE_HALF, false, false, prepare_holographic, light_solver},
    {"shadow M.R.M.A.", DPL_SHADOW_MRMA, true, false, prepare_shadow, light_shadow},
    {"shadow exact", DPL_SHADOW_EXACT, true, false, prepare_shadow, light_shadow},
};

void dpl_bench_stand_clear(dpl_bench_stand *stand) {
    dpl_solver_destroy(stand->solver);
    dpl_tracer_destroy(stand->tracer);
    dpl_flood_destroy(stand->flood.flood);
    dpl_shadow_destroy(stand->shadow);
    stand->solver = NULL;
    stand->tracer = NULL;
    stand->flood = (dpl_scene_flood){0};
    stand->shadow = NULL;
}
