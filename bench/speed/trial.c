/* Solves under the stopwatch. Called by main.c. */
#include "trial.h"

#include "../../image/picture.h"
#include "../common/clock.h"

#include <stdlib.h>

/* All that a turn holds. */
typedef struct rig {
    dpl_context *context;
    dpl_field *field;
    dpl_solver *solver;
    dpl_picture picture;
} rig;

static bool check(const rig *r, dpl_status status, dpl_error *error) {
    if (status == DPL_OK)
        return true;
    const char *message = r->context ? dpl_context_message(r->context) : "";
    return dpl_error_set(error, "%s", message[0] ? message : dpl_status_text(status));
}

bool dpl_bench_trial_prepare(dpl_bench_trial *trial, int32_t capacity, dpl_error *error) {
    trial->times = calloc(2 * (size_t)capacity, sizeof *trial->times);
    trial->capacity = capacity;
    return trial->times || dpl_error_set(error, "%s", dpl_status_text(DPL_ERROR_MEMORY));
}

void dpl_bench_trial_free(dpl_bench_trial *trial) {
    free(trial->times);
    trial->times = NULL;
}

static bool set_up(const dpl_bench_trial *trial, rig *r, dpl_error *error) {
    dpl_context_desc context = dpl_context_desc_default();
    dpl_solver_desc solver = dpl_solver_desc_default();
    context.thread_count = trial->threads;
    context.isa_mask = (uint32_t)trial->isa;
    solver.kind = trial->method->kind;
    solver.holographic.storage = trial->method->storage;
    solver.holographic.resolution = trial->method->resolution;
    solver.cascades.merge = trial->method->merge;
    solver.cascades.skip.mode = trial->method->skip;
    return check(r, dpl_context_create(&context, &r->context), error) &&
           dpl_bench_world_make(trial->world, trial->size, r->context, &r->field, error) &&
           check(r, dpl_solver_create(r->context, &solver, &r->solver), error) &&
           dpl_picture_create(&r->picture, trial->size, trial->size, 3, error);
}

static bool solve(dpl_bench_trial *trial, rig *r, int32_t frames, dpl_error *error) {
    dpl_output output = dpl_picture_output(&r->picture);
    for (int32_t frame = -1; frame < frames && trial->count < trial->capacity; frame++) {
        dpl_bench_time start = dpl_bench_now();
        if (!check(r, dpl_solver_solve(r->solver, r->field, &output), error))
            return false;
        dpl_bench_time took = dpl_bench_since(start);
        if (frame < 0)
            continue;
        trial->times[trial->count] = took.wall_ms;
        trial->times[trial->capacity + trial->count++] = took.cpu_ms;
    }
    return true;
}

bool dpl_bench_trial_run(dpl_bench_trial *trial, int32_t frames, dpl_error *error) {
    rig r = {0};
    bool good = set_up(trial, &r, error) && solve(trial, &r, frames, error);
    if (good) {
        dpl_solver_stats stats;
        dpl_solver_read_stats(r.solver, &stats);
        trial->levels = stats.level_count;
        trial->memory_bytes = stats.memory_bytes;
        trial->used = dpl_context_isa(r.context);
    }
    dpl_picture_free(&r.picture);
    dpl_solver_destroy(r.solver);
    dpl_field_destroy(r.field);
    dpl_context_destroy(r.context);
    return good;
}

void dpl_bench_trial_finish(dpl_bench_trial *trial) {
    trial->wall = dpl_bench_summarise(trial->times, trial->count);
    trial->cpu = dpl_bench_summarise(trial->times + trial->capacity, trial->count);
}
