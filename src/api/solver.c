/* The public face of solvers: argument checks, the table of methods, times. */
#include "solver/solver.h"
#include "api/light_fault.h"
#include "api/output_fault.h"
#include "shadow/face_light.h"

#include "base/desc.h"
#include "os/machine.h"

static const dpl_solver_ops *ops_of(dpl_solver_kind kind) {
    switch (kind) {
    case DPL_SOLVER_CASCADES:
        return &dpl_cascades_ops;
    case DPL_SOLVER_REFERENCE:
        return &dpl_reference_ops;
    case DPL_SOLVER_HOLOGRAPHIC:
        return &dpl_holographic_ops;
    }
    return NULL;
}

dpl_status dpl_solver_create(dpl_context *context, const dpl_solver_desc *desc, dpl_solver **out) {
    if (!context || !desc || !out)
        return DPL_ERROR_ARGUMENT;
    *out = NULL;
    if (!DPL_DESC_IS_GOOD(desc))
        return dpl_fail(context, DPL_ERROR_DESC, "the solver desc was not made by dpl_solver_desc_default()");
    const dpl_solver_ops *ops = ops_of(desc->kind);
    if (!ops)
        return dpl_fail(context, DPL_ERROR_ARGUMENT, "there is no solver %d", (int)desc->kind);
    if (desc->bounces < 0 || desc->bounces > DPL_MAX_BOUNCES)
        return dpl_fail(context, DPL_ERROR_ARGUMENT, "bounces must be 0 .. %d, not %d", DPL_MAX_BOUNCES,
                        desc->bounces);
    if (desc->reuse != 0 && desc->reuse != 1)
        return dpl_fail(context, DPL_ERROR_ARGUMENT, "reuse is 0 or 1, not %d", desc->reuse);
    dpl_solver *solver = dpl_allocate(context, 1, ops->bytes);
    if (!solver)
        return DPL_ERROR_MEMORY;
    memset(solver, 0, ops->bytes);
    solver->ops = ops;
    solver->context = context;
    solver->desc = *desc;
    solver->light_faces = dpl_face_light_fill;
    dpl_status status = ops->prepare(solver);
    if (status == DPL_OK)
        *out = solver;
    else
        dpl_solver_destroy(solver);
    return status;
}

void dpl_solver_destroy(dpl_solver *solver) {
    if (!solver)
        return;
    solver->ops->release(solver);
    dpl_reuse_free(&solver->reuse, solver->context);
    dpl_face_light_free(solver);
    dpl_buffer_free(solver->context, &solver->lights);
    dpl_release(solver->context, solver, 1, solver->ops->bytes);
}

dpl_status dpl_solver_set_lights(dpl_solver *solver, const dpl_light *lights, int32_t count) {
    if (!solver || count < 0 || (!lights && count > 0))
        return DPL_ERROR_ARGUMENT;
    DPL_TRY(dpl_lights_check(solver->context, lights, count));
    size_t bytes = (size_t)count * sizeof *lights;
    if (count == solver->light_count && (count == 0 || memcmp(solver->lights.data, lights, bytes) == 0))
        return DPL_OK;
    if (count > 0) {
        DPL_TRY(dpl_buffer_reserve(solver->context, &solver->lights, (size_t)count, sizeof *lights));
        memcpy(solver->lights.data, lights, bytes);
    }
    /* A kept frame was lit by the lights before; without bounces by none. */
    if (solver->desc.bounces > 0)
        dpl_reuse_forget(&solver->reuse);
    solver->light_count = count;
    return DPL_OK;
}

/* Is this a field that the solver may read? */
static dpl_status check_field(const dpl_solver *solver, const dpl_field *field) {
    if (field->context != solver->context)
        return dpl_fail(solver->context, DPL_ERROR_ARGUMENT, "the field was made from another context");
    return DPL_OK;
}

static dpl_status check_output(const dpl_solver *solver, const dpl_field *field, dpl_output *output) {
    dpl_output_rules rules = {dpl_field_width(field), dpl_field_height(field), "field", true};
    return dpl_output_check(solver->context, &rules, output);
}

/* Measures the field and runs the method; statistics stay those of the last success. */
static dpl_status run(dpl_solver *solver, dpl_field *field, const dpl_targets *targets) {
    double start = dpl_clock_ms();
    if (solver->ops->reads_clearance)
        DPL_TRY(dpl_field_measure(field));
    double measured = dpl_clock_ms();
    dpl_solver_stats before = solver->stats;
    dpl_status status = solver->ops->solve(solver, field, targets);
    if (status != DPL_OK) {
        solver->stats = before;
        return status;
    }
    solver->stats.field_ms = measured - start;
    solver->stats.solve_ms = dpl_clock_ms() - measured;
    return DPL_OK;
}

/* Nothing was traced, and no time spent yet. */
static void count_nothing(dpl_solver_stats *stats) {
    for (int32_t n = 0; n < stats->level_count; n++)
        stats->levels[n].traced = 0;
    stats->rays_traced = 0;
    stats->skip.signal_rays = stats->skip.guessed = stats->skip.checked = stats->skip.wrong = 0;
    stats->field_ms = stats->solve_ms = 0.0;
}

/* Into kept pictures of floats, unless they are what is wanted already. */
static dpl_status run_into_kept(dpl_solver *solver, dpl_field *field, const dpl_targets *targets) {
    dpl_reuse *reuse = &solver->reuse;
    dpl_targets kept = {{0}, {0}, {0}};
    dpl_output *outputs[DPL_REUSE_PICTURES] = {&kept.mean, &kept.cosine, &kept.sine};
    bool same, directional = targets->cosine.data != NULL;
    DPL_TRY(dpl_reuse_look(reuse, field, solver->desc.bounces > 0, directional, &same));
    if (same) {
        count_nothing(&solver->stats);
        return DPL_OK;
    }
    for (int i = 0; i < (directional ? DPL_REUSE_PICTURES : 1); i++)
        *outputs[i] = (dpl_output){
            .data = reuse->pictures[i].data,
            .width = targets->mean.width,
            .height = targets->mean.height,
            .channels = 3,
            .row_stride = (ptrdiff_t)((size_t)targets->mean.width * sizeof(float[3])),
        };
    DPL_TRY(run(solver, field, &kept));
    dpl_reuse_finish(reuse);
    solver->stats.memory_bytes += (int64_t)dpl_reuse_bytes(reuse);
    return DPL_OK;
}

static dpl_status run_with_reuse(dpl_solver *solver, dpl_field *field, const dpl_targets *targets) {
    double start = dpl_clock_ms();
    const dpl_output *const outputs[DPL_REUSE_PICTURES] = {&targets->mean, &targets->cosine, &targets->sine};
    DPL_TRY(run_into_kept(solver, field, targets));
    for (int i = 0; i < DPL_REUSE_PICTURES; i++)
        if (outputs[i]->data)
            DPL_TRY(dpl_solver_write_picture(field, outputs[i],
                                             (const float(*)[3])solver->reuse.pictures[i].data));
    solver->stats.solve_ms = dpl_clock_ms() - start - solver->stats.field_ms;
    return DPL_OK;
}

static dpl_status light(dpl_solver *solver, dpl_field *field, const dpl_targets *targets) {
    return (solver->desc.reuse ? run_with_reuse : run)(solver, field, targets);
}

dpl_status dpl_solver_solve(dpl_solver *solver, dpl_field *field, const dpl_output *output) {
    if (!solver || !field || !output)
        return DPL_ERROR_ARGUMENT;
    dpl_targets targets = {.mean = *output};
    DPL_TRY(check_field(solver, field));
    DPL_TRY(check_output(solver, field, &targets.mean));
    return light(solver, field, &targets);
}

dpl_status dpl_solver_solve_directional(dpl_solver *solver, dpl_field *field, const dpl_output *mean,
                                        const dpl_output *cosine, const dpl_output *sine) {
    if (!solver || !field || !mean || !cosine || !sine)
        return DPL_ERROR_ARGUMENT;
    dpl_targets targets = {*mean, *cosine, *sine};
    DPL_TRY(check_field(solver, field));
    DPL_TRY(check_output(solver, field, &targets.mean));
    DPL_TRY(check_output(solver, field, &targets.cosine));
    DPL_TRY(check_output(solver, field, &targets.sine));
    return light(solver, field, &targets);
}

dpl_status dpl_reference_solve_pixels(dpl_solver *solver, dpl_field *field, const int32_t (*pixels)[2],
                                      int32_t count, float (*rgb)[3]) {
    if (!solver || !field || count < 0 || (count > 0 && (!pixels || !rgb)))
        return DPL_ERROR_ARGUMENT;
    DPL_TRY(check_field(solver, field));
    if (solver->ops != &dpl_reference_ops)
        return dpl_fail(solver->context, DPL_ERROR_ARGUMENT, "solver '%s' cannot solve single pixels",
                        solver->ops->name);
    for (int32_t i = 0; i < count; i++)
        if (pixels[i][0] < 0 || pixels[i][1] < 0 || pixels[i][0] >= dpl_field_width(field) ||
            pixels[i][1] >= dpl_field_height(field))
            return dpl_fail(solver->context, DPL_ERROR_ARGUMENT, "pixel %d is (%d, %d), outside the field", i,
                            pixels[i][0], pixels[i][1]);
    double start = dpl_clock_ms();
    DPL_TRY(dpl_reference_trace_pixels(solver, field, pixels, count, rgb));
    solver->stats.solve_ms = dpl_clock_ms() - start;
    return DPL_OK;
}

void dpl_solver_read_stats(const dpl_solver *solver, dpl_solver_stats *stats) {
    *stats = solver->stats;
}

const char *dpl_solver_kind_name(dpl_solver_kind kind) {
    const dpl_solver_ops *ops = ops_of(kind);
    return ops ? ops->name : "?";
}
