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

bool dpl_cascades_keeps_levels(const dpl_cascades *c) {
    const dpl_cascades_desc *desc = &c->head.desc.cascades;
    return c->head.desc.reuse && desc->profile == DPL_PROFILE_DEFAULT && !is_surveyed(desc);
}

static size_t changed_bytes(const dpl_schedule_level *level) {
    return (size_t)level->slots * (size_t)level->probes_y * (size_t)dpl_mask_words(level->probes_x) *
           sizeof(uint64_t);
}

/* Two buffers of radiance are enough, or one for each level. */
static dpl_status hold_radiance(dpl_cascades *c, const dpl_schedule *schedule) {
    bool keeps = dpl_cascades_keeps_levels(c);
    for (int32_t n = 0; n < schedule->level_count; n++) {
        const dpl_schedule_level *level = &schedule->levels[n];
        DPL_TRY(dpl_buffer_reserve(c->head.context, &c->radiance[keeps ? n : n % 2], dpl_level_values(level),
                                   sizeof(float)));
        if (keeps)
            DPL_TRY(dpl_buffer_reserve(c->head.context, &c->changed[n % 2], changed_bytes(level), 1));
    }
    return DPL_OK;
}

static dpl_status plan(dpl_cascades *c, int32_t width, int32_t height) {
    if (c->schedule.width == width && c->schedule.height == height)
        return DPL_OK;
    c->schedule.width = 0; /* until all of it is in place */
    c->kept = false;
    dpl_schedule schedule;
    dpl_status status = dpl_schedule_compute(&c->head.desc.cascades, width, height, &schedule);
    if (status != DPL_OK)
        return dpl_fail(c->head.context, status, "no schedule for %d x %d pixels with these settings", width,
                        height);
    size_t workers = (size_t)dpl_jobs_worker_count(c->head.context->jobs);
    DPL_TRY(hold_radiance(c, &schedule));
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

/* ---- what has changed ----------------------------------------------------------------------------- */

/* A march that passes the world's corner may enter it up to a pixel beside its ray. */
#define CORNER_SPARE 1.0

static dpl_mask changed_mask(const dpl_cascades *c, int32_t n) {
    const dpl_schedule_level *level = &c->schedule.levels[n];
    return (dpl_mask){c->changed[n % 2].data, level->probes_y, dpl_mask_words(level->probes_x),
                      level->probes_x};
}

/* Nothing of level n has changed yet; what has of the level above is known. */
static dpl_dirt dirt_of(dpl_cascades *c, const dpl_field *field, int32_t n) {
    const dpl_schedule_level *level = &c->schedule.levels[n];
    const dpl_reuse *reuse = &c->head.reuse;
    bool top = n + 1 == c->schedule.level_count;
    dpl_dirt dirt = {
        .box_count = reuse->box_count,
        .slack = (double)dpl_march_margin(level, field->width, field->height) + CORNER_SPARE +
                 (top ? 0.0 : (double)dpl_ray_reach(level, c->schedule.merge)),
        .changed = changed_mask(c, n),
    };
    if (!top)
        dirt.changed_above = changed_mask(c, n + 1);
    for (int32_t i = 0; i < reuse->box_count; i++) {
        const dpl_reuse_box *box = &reuse->boxes[i];
        dirt.boxes[i] = (dpl_ray_box){box->x0, box->y0, box->x1, box->y1};
    }
    memset(dirt.changed.bits, 0, changed_bytes(level));
    return dirt;
}

/* Finds out whether this frame can be made from the kept one, and where they differ. */
static dpl_status look_at_changes(dpl_cascades *c, const dpl_field *field) {
    dpl_reuse *reuse = &c->head.reuse;
    c->partial = false;
    if (!dpl_cascades_keeps_levels(c))
        return DPL_OK;
    DPL_TRY(dpl_reuse_find_boxes(reuse, field));
    c->partial = c->kept && reuse->partial && memcmp(c->steps, c->kept_steps, sizeof c->steps) == 0;
    c->kept = false; /* until all levels are solved */
    return DPL_OK;
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
    dpl_dirt dirt;
    if (c->partial)
        dirt = dirt_of(c, field, n);
    dpl_level level = {
        .kernels = kernels,
        .march = desc->profile == DPL_PROFILE_PAPER ? kernels->march_surface : kernels->march,
        .plan = own,
        .above = top ? NULL : own + 1,
        .merge = schedule->merge,
        .grid = dpl_field_grid(field),
        .field = field,
        .directions = directions,
        .radiance_above = top ? NULL : dpl_cascades_radiance(c, n + 1),
        .radiance = dpl_cascades_radiance(c, n),
        .counters = counters,
        .number = n,
        .steps = c->steps,
        .centred = is_centred(desc),
        .survey = c->surveyed ? &c->survey.levels[n] : NULL,
        .drop_dead = drops_dead_rays(desc),
        .dirt = c->partial ? &dirt : NULL,
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

#define OWN_BUFFERS (DPL_MAX_LEVELS + 4)

static void list_buffers(dpl_cascades *c, dpl_buffer *out[OWN_BUFFERS]) {
    for (int32_t n = 0; n < DPL_MAX_LEVELS; n++)
        *out++ = &c->radiance[n];
    *out++ = &c->directions;
    *out++ = &c->rows;
    *out++ = &c->changed[0];
    *out++ = &c->changed[1];
}

static size_t bytes_of(dpl_cascades *c) {
    dpl_buffer *buffers[OWN_BUFFERS];
    size_t bytes = dpl_survey_bytes(&c->survey);
    list_buffers(c, buffers);
    for (int i = 0; i < OWN_BUFFERS; i++)
        bytes += buffers[i]->bytes;
    return bytes;
}

/* All levels are solved, with the steps of this frame. */
static void keep_levels(dpl_cascades *c) {
    c->kept = dpl_cascades_keeps_levels(c);
    memcpy(c->kept_steps, c->steps, sizeof c->steps);
}

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
    DPL_TRY(look_at_changes(c, field));
    DPL_TRY(solve_levels(c, field));
    keep_levels(c);
    solver->stats.memory_bytes = (int64_t)bytes_of(c);
    dpl_probe_plane probes = {&c->schedule.levels[0], dpl_cascades_radiance(c, 0)};
    return (paper ? dpl_probes_to_blended_pixels : dpl_probes_to_pixels)(solver->context, &probes, field,
                                                                         &targets->mean, c->rows.data);
}

static void release(dpl_solver *solver) {
    dpl_cascades *c = (dpl_cascades *)solver;
    dpl_buffer *buffers[OWN_BUFFERS];
    list_buffers(c, buffers);
    for (int i = 0; i < OWN_BUFFERS; i++)
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
