/* The holographic solver's frame: load, four quadrants of three passes each, finish. Handed out through
 * dpl_holographic_ops; see holographic.h for the method. */
#include "holographic/holographic.h"

#include "job/jobs.h"

static dpl_status prepare(dpl_solver *solver) {
    dpl_hrc *hrc = (dpl_hrc *)solver;
    dpl_storage storage = solver->desc.holographic.storage;
    if (storage != DPL_STORAGE_FLOAT && storage != DPL_STORAGE_HALF)
        return dpl_fail(solver->context, DPL_ERROR_ARGUMENT, "holographic: there is no storage %d",
                        (int)storage);
    hrc->layout.workers = dpl_jobs_worker_count(solver->context->jobs);
    return DPL_OK;
}

static void release(dpl_solver *solver) {
    dpl_buffer_free(solver->context, &((dpl_hrc *)solver)->arena);
}

/* ---- layout --------------------------------------------------------------------------------------- */

/* Is there a medium that lets different channels through differently? */
static bool is_coloured(const dpl_field *field) {
    const uint8_t *kind = field->kind.data;
    const float(*extinction)[4] = (const float(*)[4])field->extinction.data;
    for (size_t i = 0; i < dpl_field_pixels(field); i++)
        if (kind[i] == DPL_PIXEL_MEDIUM &&
            (extinction[i][0] != extinction[i][1] || extinction[i][0] != extinction[i][2]))
            return true;
    return false;
}

/* Places everything for this world, unless it lies like that already. */
static dpl_status arrange(dpl_hrc *hrc, const dpl_field *field) {
    dpl_hrc_layout *l = &hrc->layout,
                   wanted = {.half = hrc->solver.desc.holographic.storage == DPL_STORAGE_HALF,
                             .workers = l->workers};
    wanted.media = memchr(field->kind.data, DPL_PIXEL_MEDIUM, dpl_field_pixels(field)) != NULL;
    wanted.rgb = wanted.media && is_coloured(field);
    if (l->total && l->media == wanted.media && l->rgb == wanted.rgb && l->axes[0].width == field->width &&
        l->axes[1].width == field->height)
        return DPL_OK;
    l->total = 0;
    if (!dpl_hrc_arrange(&wanted, field->width, field->height))
        return dpl_fail(hrc->solver.context, DPL_ERROR_MEMORY, "holographic: the world is too large");
    DPL_TRY(dpl_buffer_reserve(hrc->solver.context, &hrc->arena, wanted.total, 1));
    *l = wanted;
    hrc->rows = &hrc->solver.context->kernels
                     ->rows[l->half ? DPL_ROWS_HALF : DPL_ROWS_FLOAT][l->rgb ? DPL_ROWS_RGB : DPL_ROWS_GREY];
    dpl_hrc_clear_segments(hrc);
    dpl_hrc_fill_weights(hrc);
    return DPL_OK;
}

/* ---- frame ---------------------------------------------------------------------------------------- */

/* Shares of the whole solve, for progress: loading, then four quadrants. */
static const double LOADED = 0.05, GATHERED = 0.95;

static dpl_status solve_quadrant(dpl_hrc *hrc, int32_t index) {
    dpl_hrc_quadrant q = dpl_hrc_quadrant_of(hrc, index);
    const dpl_hrc_axis *axis = q.axis;
    double start = LOADED + (GATHERED - LOADED) * index / 4, step = (GATHERED - LOADED) / 12;
    if (axis->levels > axis->strip_level) {
        int32_t strips = dpl_hrc_columns(axis, axis->strip_level), cones = 1 << axis->strip_level;
        DPL_TRY(dpl_solver_run(&hrc->solver, dpl_hrc_strip_task, strips - 1, 1, &q, start, start + step));
        DPL_TRY(
            dpl_solver_run(&hrc->solver, dpl_hrc_wedge_task, cones, 1, &q, start + step, start + 2 * step));
    }
    return dpl_solver_run(&hrc->solver, dpl_hrc_gather_task, dpl_hrc_gather_items(&q), 1, &q,
                          start + 2 * step, start + 3 * step);
}

static int32_t bands(int32_t rows) {
    return (rows + DPL_HRC_BAND - 1) / DPL_HRC_BAND;
}

/* What is counted: a segment per pixel, ray and level. Those of higher levels are put together, not traced.
 */
static void fill_stats(dpl_hrc *hrc) {
    dpl_solver_stats *stats = &hrc->solver.stats;
    const dpl_hrc_layout *l = &hrc->layout;
    *stats = (dpl_solver_stats){.level_count = l->levels};
    for (int32_t n = 0; n < l->levels; n++) {
        dpl_level_stats *level = &stats->levels[n];
        level->directions = 4 << n;
        for (int a = 0; a < 2; a++) {
            const dpl_hrc_axis *axis = &l->axes[a];
            if (n < axis->levels)
                level->probes += (int64_t)dpl_hrc_columns(axis, n) * axis->shape.length;
        }
        level->full = level->probes * 2 * ((1 << n) + 1);
        stats->rays_full += level->full;
        if (n <= DPL_HRC_TRACED_LEVEL)
            level->traced = dpl_ray_counter_sum(hrc->counters[n]);
        stats->rays_traced += level->traced;
    }
    stats->memory_bytes = (int64_t)hrc->arena.bytes;
}

/* A probe for each pixel of `field`. */
static dpl_status solve_pixels(dpl_hrc *hrc, const dpl_field *field, const dpl_targets *targets) {
    dpl_solver *solver = &hrc->solver;
    DPL_TRY(arrange(hrc, field));
    memset(hrc->counters, 0, sizeof hrc->counters);
    dpl_hrc_frame frame = {hrc, field, &targets->mean};
    DPL_TRY(dpl_solver_run(solver, dpl_hrc_load_task, bands(field->height), 1, &frame, 0.0, LOADED));
    dpl_hrc_mark_columns(hrc);
    dpl_hrc_fill_sky(hrc, field);
    for (int32_t quadrant = 0; quadrant < 4; quadrant++)
        DPL_TRY(solve_quadrant(hrc, quadrant));
    DPL_TRY(dpl_solver_run(solver, dpl_hrc_finish_task, bands(dpl_field_picture_height(field)), 1, &frame,
                           GATHERED, 1.0));
    fill_stats(hrc);
    return DPL_OK;
}

static dpl_status solve(dpl_solver *solver, const dpl_field *field, const dpl_targets *targets) {
    return solve_pixels((dpl_hrc *)solver, field, targets);
}

const dpl_solver_ops dpl_holographic_ops = {
    .name = "holographic",
    .bytes = sizeof(dpl_hrc),
    .prepare = prepare,
    .solve = solve,
    .release = release,
};
