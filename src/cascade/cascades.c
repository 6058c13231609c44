/* Solver "cascades": plans the levels, solves them top down with two buffers of radiance, and brings level 0
 * to pixels. Called through dpl_solver_ops. */
#include "cascade/cascades.h"
#include "cascade/pixels.h"
#include "job/jobs.h"

#include <math.h>

static const double PI = 3.14159265358979323846;

/* ---- planning ------------------------------------------------------------------------------------- */

/* What is wrong with a desc that a schedule cannot be made from, or that asks for what is not there. */
static const char *desc_fault(const dpl_cascades_desc *desc) {
    dpl_cascades_desc plain = *desc;
    dpl_schedule schedule;
    memset(&plain.skip, 0, sizeof plain.skip);
    if (dpl_schedule_compute(&plain, 1, 1, &schedule) != DPL_OK)
        return "spacing is 1 .. 64, directions 4 .. 1024 in steps of 4, interval 0.25 .. 1024, "
               "levels 1 .. 12, and merge and profile must exist";
    if (dpl_schedule_compute(desc, 1, 1, &schedule) != DPL_OK)
        return "skip: the mode must exist, thresholds rise from above 0, the start level is 0 or more, "
               "bits are 0 .. 2, signal probes at most 65536, the bound is 0 or 20 .. 120, switches as "
               "listed";
    if (desc->profile == DPL_PROFILE_PAPER && desc->merge != DPL_MERGE_BILINEAR)
        return "the paper profile knows no merge but bilinear";
    return NULL;
}

static dpl_status prepare(dpl_solver *solver) {
    const char *fault = desc_fault(&solver->desc.cascades);
    if (!fault && solver->desc.bounces > 0)
        fault = "light does not bounce here: bounces must be 0";
    return fault ? dpl_fail(solver->context, DPL_ERROR_ARGUMENT, "cascades: %s", fault) : DPL_OK;
}

/* Directions of all levels, in steps of half a ray: a ray that stands for a group may point between two. */
static dpl_status fill_directions(dpl_cascades *c) {
    size_t total = 0;
    for (int32_t n = 0; n < c->schedule.level_count; n++)
        total += 2 * (size_t)c->schedule.levels[n].directions;
    DPL_TRY(dpl_buffer_reserve(c->head.context, &c->directions, total, 2 * sizeof(float)));
    float(*out)[2] = c->directions.data;
    for (int32_t n = 0; n < c->schedule.level_count; n++) {
        int32_t count = c->schedule.levels[n].directions;
        for (int64_t half = 0; half < 2 * (int64_t)count; half++, out++) {
            double angle = PI * (double)half / count;
            (*out)[0] = (float)cos(angle);
            (*out)[1] = (float)sin(angle);
        }
    }
    return DPL_OK;
}

static bool is_surveyed(const dpl_cascades_desc *desc) {
    return desc->skip.mode == DPL_SKIP_EXACT || desc->skip.mode == DPL_SKIP_BOUNDED;
}

static dpl_status plan(dpl_cascades *c, int32_t width, int32_t height) {
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
    if (is_surveyed(&c->head.desc.cascades))
        DPL_TRY(dpl_survey_plan(&c->survey, c->head.context, &c->schedule,
                                c->head.desc.cascades.skip.mode == DPL_SKIP_BOUNDED));
    c->schedule.width = width;
    return DPL_OK;
}

/* ---- levels --------------------------------------------------------------------------------------- */

static bool is_centred(const dpl_cascades_desc *desc) {
    if (desc->skip.placement == DPL_PLACEMENT_PROFILE)
        return desc->profile == DPL_PROFILE_DEFAULT;
    return desc->skip.placement == DPL_PLACEMENT_CENTRED;
}

static bool drops_dead_rays(const dpl_cascades_desc *desc) {
    if (is_centred(desc))
        return false; /* every slot is read */
    if (desc->skip.dead_rays == DPL_DEAD_RAYS_PROFILE)
        return desc->profile == DPL_PROFILE_DEFAULT;
    return desc->skip.dead_rays == DPL_DEAD_RAYS_DROP;
}

dpl_status dpl_cascades_solve_level(dpl_cascades *c, const dpl_field *field, int32_t n, double done,
                                    double more, int64_t *rays) {
    const dpl_schedule *schedule = &c->schedule;
    const dpl_schedule_level *own = &schedule->levels[n];
    const dpl_cascades_desc *desc = &c->head.desc.cascades;
    const dpl_kernels *kernels = c->head.context->kernels;
    dpl_ray_counter counters[DPL_MAX_THREADS] = {{0}};
    const float(*directions)[2] = c->directions.data;
    for (int32_t below = 0; below < n; below++)
        directions += 2 * schedule->levels[below].directions;
    bool top = n + 1 == schedule->level_count;
    dpl_level level = {
        .kernels = kernels,
        .march = desc->profile == DPL_PROFILE_PAPER ? kernels->march_surface : kernels->march,
        .plan = own,
        .above = top ? NULL : own + 1,
        .merge = schedule->merge,
        .grid = dpl_field_grid(field),
        .field = field,
        .directions = directions,
        .radiance_above = top ? NULL : c->radiance[(n + 1) % 2].data,
        .radiance = c->radiance[n % 2].data,
        .counters = counters,
        .number = n,
        .steps = c->steps,
        .centred = is_centred(desc),
        .survey = c->surveyed ? &c->survey.levels[n] : NULL,
        .drop_dead = drops_dead_rays(desc),
    };
    DPL_TRY(dpl_solver_run(&c->head, dpl_level_solve, dpl_level_items(own), 1, &level, done, done + more));
    *rays = dpl_ray_counter_sum(counters);
    return DPL_OK;
}

/* All levels from the top, into stats. */
static dpl_status solve_levels(dpl_cascades *c, const dpl_field *field) {
    dpl_solver_stats *stats = &c->head.stats;
    double done = 0.0;
    stats->level_count = c->schedule.level_count;
    for (int32_t n = c->schedule.level_count - 1; n >= 0; n--) {
        const dpl_schedule_level *plan = &c->schedule.levels[n];
        double share = (double)plan->rays / (double)c->schedule.rays;
        dpl_level_stats *level = &stats->levels[n];
        int64_t rays;
        DPL_TRY(dpl_cascades_solve_level(c, field, n, done, share, &rays));
        level->traced += rays;
        done += share;
        level->probes = (int64_t)plan->probes_x * plan->probes_y;
        level->directions = plan->directions;
        level->full = plan->rays;
        stats->rays_full += level->full;
        stats->rays_traced += level->traced;
    }
    return DPL_OK;
}

/* ---- the solver ----------------------------------------------------------------------------------- */

static dpl_status solve(dpl_solver *solver, const dpl_field *field, const dpl_targets *targets) {
    dpl_cascades *c = (dpl_cascades *)solver;
    bool paper = solver->desc.cascades.profile == DPL_PROFILE_PAPER;
    if (paper && !field->surface.data)
        return dpl_fail(solver->context, DPL_ERROR_ARGUMENT,
                        "the paper profile wants a field that was made with keep_shape_distance");
    if (targets->cosine.data || targets->sine.data)
        return dpl_fail(solver->context, DPL_ERROR_ARGUMENT, "cascades: there is no directional output");
    DPL_TRY(plan(c, field->width, field->height));
    memset(&solver->stats, 0, sizeof solver->stats);
    c->surveyed = false; /* signals are measured on a picture with all its rays */
    DPL_TRY(dpl_cascades_choose(c, field));
    if (is_surveyed(&solver->desc.cascades))
        DPL_TRY(dpl_cascades_survey(c, field));
    c->surveyed = is_surveyed(&solver->desc.cascades);
    DPL_TRY(solve_levels(c, field));
    solver->stats.memory_bytes = (int64_t)(c->directions.bytes + c->radiance[0].bytes + c->radiance[1].bytes +
                                           c->rows.bytes + dpl_survey_bytes(&c->survey));
    dpl_probe_plane probes = {&c->schedule.levels[0], c->radiance[0].data};
    return (paper ? dpl_probes_to_blended_pixels : dpl_probes_to_pixels)(solver->context, &probes, field,
                                                                         &targets->mean, c->rows.data);
}

static void release(dpl_solver *solver) {
    dpl_cascades *c = (dpl_cascades *)solver;
    dpl_buffer *buffers[] = {&c->directions, &c->radiance[0], &c->radiance[1], &c->rows};
    for (size_t i = 0; i < sizeof buffers / sizeof buffers[0]; i++)
        dpl_buffer_free(solver->context, buffers[i]);
    dpl_survey_free(&c->survey, solver->context);
}

const dpl_solver_ops dpl_cascades_ops = {
    .name = "cascades",
    .bytes = sizeof(dpl_cascades),
    .reads_clearance = true,
    .prepare = prepare,
    .solve = solve,
    .release = release,
};
