/* Draws a frame, solves it anew; draws it again, solves it with reuse; compares. The measuring of distances,
 * which drawing makes necessary, is part of either time. */
#include "measure.h"

#include "../common/clock.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef struct rig {
    dpl_scene scene;
    dpl_field *fields[DPL_BENCH_WAYS];
    dpl_solver *solvers[DPL_BENCH_WAYS];
    float *rgb[DPL_BENCH_WAYS];
} rig;

static bool failed(dpl_context *context, dpl_status status, dpl_error *error) {
    const char *message = dpl_context_message(context);
    return dpl_error_set(error, "%s", message[0] ? message : dpl_status_text(status));
}

static bool set_up(dpl_context *context, const dpl_bench_row *row, rig *r, dpl_error *error) {
    size_t floats = 3 * (size_t)row->size * (size_t)row->size;
    if (!dpl_bench_situation_scene(row->situation, row->size, &r->scene, error))
        return false;
    for (int way = 0; way < DPL_BENCH_WAYS; way++) {
        dpl_solver_desc desc = dpl_solver_desc_default();
        desc.kind = row->method->kind;
        desc.cascades.merge = row->method->merge;
        desc.reuse = way;
        dpl_status status = dpl_solver_create(context, &desc, &r->solvers[way]);
        if (status != DPL_OK)
            return failed(context, status, error);
        r->rgb[way] = malloc(floats * sizeof(float));
        if (!r->rgb[way])
            return dpl_error_set(error, "%s", dpl_status_text(DPL_ERROR_MEMORY));
        if (!dpl_scene_build_field(&r->scene, context, false, &r->fields[way], error))
            return false;
    }
    return true;
}

static void note(dpl_bench_row *row, int way, int32_t frame, double ms, const dpl_solver_stats *stats) {
    row->memory[way] = stats->memory_bytes;
    if (frame == 0)
        return; /* allocates */
    row->cpu_ms[way] = frame == 1 ? ms : fmin(row->cpu_ms[way], ms);
    row->most_ms[way] = fmax(row->most_ms[way], ms);
    row->rays[way] += stats->rays_traced;
}

static bool run_frame(dpl_context *context, const rig *r, int32_t frame, dpl_bench_row *row,
                      dpl_error *error) {
    size_t bytes = 3 * (size_t)row->size * (size_t)row->size * sizeof(float);
    for (int way = 0; way < DPL_BENCH_WAYS; way++) {
        dpl_solver_stats stats;
        dpl_output output = {.data = r->rgb[way], .width = row->size, .height = row->size, .channels = 3};
        if (!dpl_bench_situation_draw(row->situation, &r->scene, context, frame, r->fields[way], error))
            return false;
        dpl_bench_time start = dpl_bench_now();
        dpl_status status = dpl_solver_solve(r->solvers[way], r->fields[way], &output);
        double ms = dpl_bench_since(start).cpu_ms;
        if (status != DPL_OK)
            return failed(context, status, error);
        dpl_solver_read_stats(r->solvers[way], &stats);
        note(row, way, frame, ms, &stats);
    }
    row->equal &= memcmp(r->rgb[DPL_BENCH_ANEW], r->rgb[DPL_BENCH_REUSE], bytes) == 0;
    return true;
}

bool dpl_bench_reuse_measure(dpl_context *context, int32_t frames, dpl_bench_row *row, dpl_error *error) {
    rig r = {0};
    bool good = set_up(context, row, &r, error);
    row->equal = true;
    for (int32_t frame = 0; frame <= frames && good; frame++)
        good = run_frame(context, &r, frame, row, error);
    for (int way = 0; way < DPL_BENCH_WAYS; way++) {
        row->rays[way] /= frames;
        dpl_solver_destroy(r.solvers[way]);
        dpl_field_destroy(r.fields[way]);
        free(r.rgb[way]);
    }
    dpl_scene_free(&r.scene);
    return good;
}
