/* Runs frames under stopwatches and a counting allocator. Called by main.c. */
#include "measure.h"

#include "../common/clock.h"

#include <stdlib.h>

static bool check(const dpl_bench_rig *rig, dpl_status status, dpl_error *error) {
    if (status == DPL_OK)
        return true;
    const char *message = rig->context ? dpl_context_message(rig->context) : "";
    return dpl_error_set(error, "%s", message[0] ? message : dpl_status_text(status));
}

static bool set_up(dpl_bench_rig *rig, const dpl_bench_subject *subject, const dpl_bench_case *which,
                   dpl_error *error) {
    dpl_context_desc context = dpl_context_desc_default();
    dpl_solver_desc solver = dpl_solver_desc_default();
    rig->which = *which;
    rig->frames = subject->frames;
    context.allocator = dpl_bench_memory_allocator(&rig->memory);
    context.thread_count = which->threads;
    solver.kind = DPL_SOLVER_CASCADES;
    solver.cascades.merge = which->merge;
    if (!subject->family->make(subject->seed, subject->scene, which->size, &rig->scene, error) ||
        !check(rig, dpl_context_create(&context, &rig->context), error) ||
        !dpl_scene_build_field(&rig->scene, rig->context, false, &rig->field, error) ||
        !check(rig, dpl_solver_create(rig->context, &solver, &rig->solver), error) ||
        !dpl_picture_create(&rig->picture, rig->scene.width, rig->scene.height, 3, error))
        return false;
    rig->distance = malloc((size_t)rig->scene.width * (size_t)rig->scene.height * sizeof *rig->distance);
    rig->times = calloc((size_t)(2 * DPL_BENCH_PARTS * subject->frames), sizeof *rig->times);
    return check(rig, rig->distance && rig->times ? DPL_OK : DPL_ERROR_MEMORY, error);
}

void dpl_bench_rig_free(dpl_bench_rig *rig) {
    free(rig->times);
    free(rig->distance);
    dpl_picture_free(&rig->picture);
    dpl_solver_destroy(rig->solver);
    dpl_field_destroy(rig->field);
    dpl_context_destroy(rig->context);
    dpl_scene_free(&rig->scene);
    *rig = (dpl_bench_rig){0};
}

bool dpl_bench_rig_create(const dpl_bench_subject *subject, const dpl_bench_case *which, dpl_bench_rig *rig,
                          dpl_error *error) {
    if (set_up(rig, subject, which, error))
        return true;
    dpl_bench_rig_free(rig);
    return false;
}

static bool run_part(dpl_bench_rig *rig, dpl_bench_part part, dpl_error *error) {
    dpl_output output = dpl_picture_output(&rig->picture);
    switch (part) {
    case DPL_BENCH_DRAW:
        return dpl_scene_draw(&rig->scene, rig->context, rig->field, error);
    case DPL_BENCH_DISTANCE:
        return check(rig, dpl_field_read_distance(rig->field, rig->distance, 0), error);
    default:
        return check(rig, dpl_solver_solve(rig->solver, rig->field, &output), error);
    }
}

bool dpl_bench_rig_frame(dpl_bench_rig *rig, int32_t frame, dpl_error *error) {
    for (int32_t part = 0; part < DPL_BENCH_PARTS; part++) {
        dpl_bench_time start = dpl_bench_now();
        if (!run_part(rig, (dpl_bench_part)part, error))
            return false;
        dpl_bench_time took = dpl_bench_since(start);
        if (frame < 0)
            continue;
        rig->times[part * rig->frames + frame] = took.wall_ms;
        rig->times[(DPL_BENCH_PARTS + part) * rig->frames + frame] = took.cpu_ms;
    }
    if (frame < 0)
        rig->first_allocations = rig->memory.calls;
    return true;
}

dpl_bench_measurement dpl_bench_rig_read(dpl_bench_rig *rig) {
    dpl_solver_stats stats;
    dpl_solver_read_stats(rig->solver, &stats);
    dpl_bench_measurement m = {
        .which = rig->which,
        .levels = stats.level_count,
        .rays = stats.rays_traced,
        .solver_bytes = stats.memory_bytes,
        .total_bytes = rig->memory.peak,
        .later_allocations = rig->memory.calls - rig->first_allocations,
    };
    for (int32_t part = 0; part < DPL_BENCH_PARTS; part++) {
        double *wall = rig->times + part * rig->frames;
        double *cpu = rig->times + (DPL_BENCH_PARTS + part) * rig->frames;
        m.wall_ms[part] = dpl_bench_summarise(wall, rig->frames);
        m.cpu_ms[part] = dpl_bench_summarise(cpu, rig->frames);
    }
    return m;
}
