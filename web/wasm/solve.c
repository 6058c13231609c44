/* Solvers and shadows behind plain numbers. */
#include "solve.h"

#include <stdlib.h>
#include <string.h>

static dpl_status make_solver(dpl_web_session *session, const dpl_web_settings *settings) {
    dpl_solver_desc desc = dpl_solver_desc_default();
    desc.kind = (dpl_solver_kind)settings->solver;
    desc.bounces = settings->bounces;
    desc.cascades.merge = (dpl_merge)settings->merge;
    desc.cascades.skip.mode = (dpl_skip_mode)settings->skip;
    desc.cascades.skip.bound_db = settings->bound_db;
    desc.cascades.skip.measure = 1; /* a few thousand rays, and pages show the signals */
    desc.reference.directions = settings->directions;
    desc.reuse = settings->reuse;
    desc.progress = settings->watched ? dpl_web_progress_hook : NULL;
    dpl_solver_destroy(session->solver);
    session->solver = NULL;
    session->settings = *settings;
    return dpl_solver_create(session->context, &desc, &session->solver);
}

static dpl_output light_of(const dpl_web_session *session) {
    return (dpl_output){.data = session->planes[DPL_WEB_LIGHT],
                        .format = DPL_FORMAT_F32,
                        .width = session->width,
                        .height = session->height,
                        .channels = 3};
}

int32_t dpl_web_solve(dpl_web_session *session, int32_t solver, int32_t bounces, int32_t merge, int32_t skip,
                      double bound_db, int32_t directions, int32_t watched, int32_t reuse) {
    dpl_web_settings settings;
    memset(&settings, 0, sizeof settings); /* padding too: settings are compared as bytes */
    settings.solver = solver;
    settings.bounces = bounces;
    settings.merge = merge;
    settings.skip = skip;
    settings.bound_db = bound_db;
    settings.directions = directions;
    settings.watched = watched;
    settings.reuse = reuse;
    if (!session->field)
        return DPL_ERROR_SIZE;
    dpl_status status = DPL_OK;
    if (!session->solver || memcmp(&settings, &session->settings, sizeof settings) != 0)
        status = make_solver(session, &settings);
    dpl_output output = light_of(session);
    if (status == DPL_OK)
        status = dpl_solver_solve(session->solver, session->field, &output);
    return (int32_t)status;
}

void dpl_web_stats(const dpl_web_session *session, double *values) {
    dpl_solver_stats stats;
    dpl_solver_read_stats(session->solver, &stats);
    const dpl_signals *signals = &stats.skip.signals;
    const double head[DPL_WEB_STATS] = {
        stats.level_count,        (double)stats.rays_full, (double)stats.rays_traced,
        stats.field_ms,           stats.solve_ms,          (double)stats.memory_bytes,
        stats.skip.mode,          stats.skip.measured,     signals->mean,
        signals->stddev,          signals->score,          signals->non_zero,
        signals->peak_to_average, signals->bandwidth90,    (double)stats.skip.signal_rays};
    memcpy(values, head, sizeof head);
    for (int32_t n = 0; n < stats.level_count; n++) {
        const dpl_level_stats *level = &stats.levels[n];
        const double numbers[DPL_WEB_LEVEL_STATS] = {(double)level->probes, level->directions,
                                                     (double)level->full, (double)level->traced};
        memcpy(values + DPL_WEB_STATS + n * DPL_WEB_LEVEL_STATS, numbers, sizeof numbers);
    }
}

static dpl_status make_shadow(dpl_web_session *session, int32_t method) {
    dpl_shadow_desc desc = dpl_shadow_desc_default();
    desc.method = (dpl_shadow_method)method;
    desc.progress = dpl_web_progress_hook;
    dpl_shadow_destroy(session->shadow);
    session->shadow = NULL;
    session->shadow_method = method;
    return dpl_shadow_create(session->context, &desc, &session->shadow);
}

static dpl_light light_from(const double row[7]) {
    return (dpl_light){.position = {row[0], row[1]},
                       .radius = row[2],
                       .color = {(float)row[3], (float)row[4], (float)row[5]},
                       .intensity = (float)row[6]};
}

int32_t dpl_web_shadow(dpl_web_session *session, int32_t method, const double *rows, int32_t count) {
    if (!session->field || count < 0)
        return DPL_ERROR_SIZE;
    dpl_status status = DPL_OK;
    if (!session->shadow || session->shadow_method != method)
        status = make_shadow(session, method);
    if (status != DPL_OK)
        return (int32_t)status;
    dpl_light *lights = malloc(((size_t)count + 1) * sizeof *lights); /* never of no size */
    if (!lights)
        return DPL_ERROR_MEMORY;
    for (int32_t i = 0; i < count; i++)
        lights[i] = light_from(rows + 7 * i);
    dpl_output output = light_of(session);
    status = dpl_shadow_light(session->shadow, session->field, lights, count, &output);
    free(lights);
    return (int32_t)status;
}
