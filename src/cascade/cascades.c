/* Solver "cascades": plans the levels, solves them top down with two buffers of radiance, and brings level 0
 * to pixels. Called through dpl_solver_ops. */
#include "cascade/level.h"
#include "cascade/pixels.h"
#include "job/jobs.h"
#include "solver/solver.h"

#include <math.h>

static const double PI = 3.14159265358979323846;

typedef struct cascades {
    dpl_solver head;
    dpl_schedule schedule;  /* of the last size */
    dpl_buffer directions;  /* float[2] per ray, all levels one after another */
    dpl_buffer radiance[2]; /* level n is in [n % 2] */
    dpl_buffer rows;        /* of the output pass: 3 rows of pixels per worker */
} cascades;

/* ---- planning -------------------------------------------------------------------------------------------
 */

static dpl_status prepare(dpl_solver *solver) {
    dpl_schedule schedule;
    dpl_status status = dpl_schedule_compute(&solver->desc.cascades, 1, 1, &schedule);
    if (status == DPL_OK)
        return DPL_OK;
    return dpl_fail(
        solver->context, status,
        "cascades want spacing 1 .. 64, directions 4 .. 1024 in steps of 4, interval 0.25 .. 1024, "
        "levels 1 .. %d and a merge that exists",
        DPL_MAX_LEVELS);
}

static dpl_status fill_directions(cascades *c) {
    size_t total = 0;
    for (int32_t n = 0; n < c->schedule.level_count; n++)
        total += (size_t)c->schedule.levels[n].directions;
    DPL_TRY(dpl_buffer_reserve(c->head.context, &c->directions, total, 2 * sizeof(float)));
    float(*out)[2] = c->directions.data;
    for (int32_t n = 0; n < c->schedule.level_count; n++) {
        int32_t count = c->schedule.levels[n].directions;
        for (int32_t k = 0; k < count; k++, out++) {
            double angle = 2.0 * PI * (k + 0.5) / count;
            (*out)[0] = (float)cos(angle);
            (*out)[1] = (float)sin(angle);
        }
    }
    return DPL_OK;
}

static dpl_status plan(cascades *c, int32_t width, int32_t height) {
    if (c->schedule.width == width && c->schedule.height == height)
        return DPL_OK;
    c->schedule.width = 0; /* until all of it is in place */
    dpl_schedule schedule;
    dpl_status status = dpl_schedule_compute(&c->head.desc.cascades, width, height, &schedule);
    if (status != DPL_OK)
        return dpl_fail(c->head.context, status, "no schedule for %d x %d pixels with these settings", width,
                        height);
    size_t bytes[2] = {0, 0};
    for (int32_t n = 0; n < schedule.level_count; n++)
        if ((size_t)schedule.levels[n].bytes > bytes[n % 2])
            bytes[n % 2] = (size_t)schedule.levels[n].bytes;
    size_t workers = (size_t)dpl_jobs_worker_count(c->head.context->jobs);
    DPL_TRY(dpl_buffer_reserve(c->head.context, &c->radiance[0], bytes[0], 1));
    DPL_TRY(dpl_buffer_reserve(c->head.context, &c->radiance[1], bytes[1], 1));
    DPL_TRY(dpl_buffer_reserve(c->head.context, &c->rows, workers * 3 * (size_t)width, sizeof(float)));
    c->schedule = schedule;
    c->schedule.width = 0;
    DPL_TRY(fill_directions(c));
    c->schedule.width = width;
    return DPL_OK;
}

/* ---- levels ---------------------------------------------------------------------------------------------
 */

/* Solves level n and counts its rays. `done` is the share of all rays that is behind. */
static dpl_status solve_level(cascades *c, const dpl_field *field, int32_t n, double *done) {
    const dpl_schedule *schedule = &c->schedule;
    const dpl_schedule_level *own = &schedule->levels[n];
    dpl_ray_counter counters[DPL_MAX_THREADS] = {{0}};
    const float(*directions)[2] = c->directions.data;
    for (int32_t below = 0; below < n; below++)
        directions += schedule->levels[below].directions;
    bool top = n + 1 == schedule->level_count;
    dpl_level level = {
        .kernels = c->head.context->kernels,
        .plan = own,
        .above = top ? NULL : own + 1,
        .merge = schedule->merge,
        .grid = dpl_field_grid(field),
        .sky = field->sky,
        .directions = directions,
        .radiance_above = top ? NULL : c->radiance[(n + 1) % 2].data,
        .radiance = c->radiance[n % 2].data,
        .counters = counters,
    };
    double after = *done + (double)own->rays / (double)schedule->rays;
    DPL_TRY(dpl_solver_run(&c->head, dpl_level_solve, dpl_level_items(own), 1, &level, *done, after));
    *done = after;
    dpl_level_stats *stats = &c->head.stats.levels[n];
    stats->probes = (int64_t)own->probes_x * own->probes_y;
    stats->directions = own->directions;
    stats->full = own->rays;
    stats->traced = dpl_ray_counter_sum(counters);
    return DPL_OK;
}

/* ---- the solver -----------------------------------------------------------------------------------------
 */

static dpl_status solve(dpl_solver *solver, const dpl_field *field, const dpl_output *output) {
    cascades *c = (cascades *)solver;
    DPL_TRY(plan(c, field->width, field->height));
    dpl_solver_stats *stats = &solver->stats;
    memset(stats, 0, sizeof *stats);
    stats->level_count = c->schedule.level_count;
    double done = 0.0;
    for (int32_t n = c->schedule.level_count - 1; n >= 0; n--)
        DPL_TRY(solve_level(c, field, n, &done));
    for (int32_t n = 0; n < stats->level_count; n++) {
        stats->rays_full += stats->levels[n].full;
        stats->rays_traced += stats->levels[n].traced;
    }
    stats->memory_bytes =
        (int64_t)(c->directions.bytes + c->radiance[0].bytes + c->radiance[1].bytes + c->rows.bytes);
    return dpl_probes_to_pixels(solver->context,
                                &(dpl_probe_plane){&c->schedule.levels[0], c->radiance[0].data}, field,
                                output, c->rows.data);
}

static void release(dpl_solver *solver) {
    cascades *c = (cascades *)solver;
    dpl_buffer *buffers[] = {&c->directions, &c->radiance[0], &c->radiance[1], &c->rows};
    for (size_t i = 0; i < sizeof buffers / sizeof buffers[0]; i++)
        dpl_buffer_free(solver->context, buffers[i]);
}

const dpl_solver_ops dpl_cascades_ops = {
    .name = "cascades",
    .bytes = sizeof(cascades),
    .prepare = prepare,
    .solve = solve,
    .release = release,
};
