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
    if (storage == DPL_STORAGE_HALF && !solver->context->kernels->rows[DPL_ROWS_HALF][DPL_ROWS_GREY].trace)
        return dpl_fail(solver->context, DPL_ERROR_UNAVAILABLE,
                        "holographic: this build has no half storage");
    dpl_resolution resolution = solver->desc.holographic.resolution;
    if (resolution < DPL_RESOLUTION_FULL || resolution > DPL_RESOLUTION_DOUBLE)
        return dpl_fail(solver->context, DPL_ERROR_ARGUMENT, "holographic: there is no resolution %d",
                        (int)resolution);
    hrc->resolution.kind = resolution;
    hrc->layout.workers = dpl_jobs_worker_count(solver->context->jobs);
    hrc->layout.strip_bytes = DPL_HRC_STRIP_BYTES;
    hrc->layout.wedge_bytes = DPL_HRC_WEDGE_BYTES;
    return DPL_OK;
}

static void release(dpl_solver *solver) {
    dpl_hrc *hrc = (dpl_hrc *)solver;
    dpl_hrc_resolution_free(solver->context, &hrc->resolution);
    dpl_buffer *buffers[] = {&hrc->arena, &hrc->lit.first, &hrc->lit.faces, &hrc->lit.rgb};
    for (size_t i = 0; i < sizeof buffers / sizeof buffers[0]; i++)
        dpl_buffer_free(solver->context, buffers[i]);
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
static dpl_status arrange(dpl_hrc *hrc, const dpl_field *field, const dpl_targets *targets) {
    dpl_hrc_layout *l = &hrc->layout,
                   wanted = {.half = hrc->solver.desc.holographic.storage == DPL_STORAGE_HALF,
                             .workers = l->workers,
                             .strip_bytes = l->strip_bytes,
                             .wedge_bytes = l->wedge_bytes};
    wanted.media = memchr(field->kind.data, DPL_PIXEL_MEDIUM, dpl_field_pixels(field)) != NULL;
    wanted.rgb = wanted.media && is_coloured(field);
    wanted.faces = hrc->solver.desc.bounces > 0 && field->albedo.data;
    wanted.directional = wanted.faces || targets->cosine.data;
    wanted.keeps =
        hrc->solver.desc.reuse && hrc->resolution.kind == DPL_RESOLUTION_FULL && !wanted.directional;
    if (l->total && l->media == wanted.media && l->rgb == wanted.rgb && l->faces == wanted.faces &&
        l->directional == wanted.directional && l->keeps == wanted.keeps &&
        l->axes[0].width == field->width && l->axes[1].width == field->height)
        return DPL_OK;
    l->total = 0;
    hrc->kept = false;
    if (!dpl_hrc_arrange(&wanted, field->width, field->height))
        return dpl_fail(hrc->solver.context, DPL_ERROR_MEMORY, "holographic: the world is too large");
    DPL_TRY(dpl_buffer_reserve(hrc->solver.context, &hrc->arena, wanted.total, 1));
    *l = wanted;
    hrc->rows = &hrc->solver.context->kernels
                     ->rows[l->half ? DPL_ROWS_HALF : DPL_ROWS_FLOAT][l->rgb ? DPL_ROWS_RGB : DPL_ROWS_GREY];
    dpl_hrc_clear_segments(hrc);
    dpl_hrc_fill_weights(hrc);
    dpl_hrc_prepare_near(hrc);
    return DPL_OK;
}

/* ---- frame ---------------------------------------------------------------------------------------- */

/* Shares of the whole solve, for progress: loading, then passes of four quadrants. The picture is written
 * without asking whether to go on: a cancelled solve leaves the output alone. */
static const double LOADED = 0.05, GATHERED = 1.0;

static dpl_status solve_quadrant(dpl_hrc *hrc, int32_t index, double start, double end) {
    dpl_hrc_quadrant q = dpl_hrc_quadrant_of(hrc, index);
    const dpl_hrc_axis *axis = q.axis;
    double step = (end - start) / 3;
    if (q.partial)
        dpl_hrc_find_changed_world(&q);
    if (axis->levels > axis->strip_level) {
        int32_t strips = dpl_hrc_columns(axis, axis->strip_level), cones = 1 << axis->strip_level;
        DPL_TRY(dpl_solver_run(&hrc->solver, dpl_hrc_strip_task, strips - 1, 1, &q, start, start + step));
        DPL_TRY(
            dpl_solver_run(&hrc->solver, dpl_hrc_wedge_task, cones, 1, &q, start + step, start + 2 * step));
    }
    if (q.partial)
        dpl_hrc_find_gathers(&q);
    return dpl_solver_run(&hrc->solver, dpl_hrc_gather_task, dpl_hrc_gather_items(&q), 1, &q,
                          start + 2 * step, end);
}

static int32_t bands(int32_t rows) {
    return (rows + DPL_HRC_BAND - 1) / DPL_HRC_BAND;
}

/* Light is solved once, and once more for every bounce. */
static int32_t passes_of(const dpl_hrc *hrc) {
    return hrc->layout.faces ? hrc->solver.desc.bounces + 1 : 1;
}

/* What is counted: a segment per pixel, ray, level and pass. Those of higher levels are put together, not
 * traced. Levels that the statistics have no place for are added to the last one. */
static void fill_stats(dpl_hrc *hrc) {
    dpl_solver_stats *stats = &hrc->solver.stats;
    const dpl_hrc_layout *l = &hrc->layout;
    *stats = (dpl_solver_stats){.level_count = l->levels < DPL_MAX_LEVELS ? l->levels : DPL_MAX_LEVELS};
    for (int32_t n = 0; n < l->levels; n++) {
        dpl_level_stats *level = &stats->levels[n < DPL_MAX_LEVELS ? n : DPL_MAX_LEVELS - 1];
        int64_t probes = 0, rays = passes_of(hrc) * 2 * ((1 << n) + 1);
        for (int a = 0; a < 2; a++) {
            const dpl_hrc_axis *axis = &l->axes[a];
            if (n < axis->levels)
                probes += (int64_t)dpl_hrc_columns(axis, n) * axis->shape.length;
        }
        level->directions = 4 << n;
        level->probes += probes;
        level->full += probes * rays;
        stats->rays_full += probes * rays;
        if (n <= DPL_HRC_BETWEEN_LEVEL)
            level->traced = dpl_ray_counter_sum(hrc->counters[n]);
        stats->rays_traced += level->traced;
    }
    stats->memory_bytes =
        (int64_t)(hrc->arena.bytes + hrc->lit.first.bytes + hrc->lit.faces.bytes + hrc->lit.rgb.bytes);
}

/* Light after no bounce, then what walls reflect of it, and again. */
static dpl_status solve_passes(dpl_hrc *hrc, dpl_hrc_frame *frame) {
    int32_t passes = passes_of(hrc);
    double step = (GATHERED - LOADED) / (4 * passes);
    hrc->faces_lit = false;
    dpl_hrc_clear_faces(hrc);
    for (int32_t pass = 0; pass < passes; pass++) {
        double start = LOADED + 4 * step * pass;
        for (int32_t quadrant = 0; quadrant < 4; quadrant++)
            DPL_TRY(solve_quadrant(hrc, quadrant, start + step * quadrant, start + step * (quadrant + 1)));
        if (pass == passes - 1)
            break;
        DPL_TRY(dpl_jobs_run(hrc->solver.context, dpl_hrc_faces_task, bands(frame->field->height), 1, frame));
        hrc->faces_lit = true;
    }
    return DPL_OK;
}

/* Where frames are kept: which columns have new sums is known. */
static dpl_status add_ways(dpl_hrc *hrc) {
    for (int axis = 0; axis < 2 && hrc->layout.keeps; axis++) {
        dpl_hrc_ways ways = {hrc, axis};
        DPL_TRY(dpl_jobs_run(hrc->solver.context, dpl_hrc_add_ways_task, hrc->layout.axes[axis].width, 16,
                             &ways));
    }
    return DPL_OK;
}

/* Can this frame be made from the last one? Until it is done none is kept. */
static void start_frame(dpl_hrc *hrc) {
    hrc->partial = hrc->kept && hrc->solver.reuse.partial;
    hrc->kept = false;
    if (hrc->layout.keeps)
        dpl_hrc_start_frame(hrc);
}

/* A probe for each pixel of `field`. `margin`: of the caller's. */
static dpl_status solve_pixels(dpl_hrc *hrc, const dpl_field *field, const dpl_targets *targets,
                               int32_t margin) {
    dpl_solver *solver = &hrc->solver;
    DPL_TRY(arrange(hrc, field, targets));
    memset(hrc->counters, 0, sizeof hrc->counters);
    dpl_hrc_frame frame = {hrc, field, targets};
    start_frame(hrc);
    DPL_TRY(dpl_solver_run(solver, dpl_hrc_load_task, bands(field->height), 1, &frame, 0.0, LOADED));
    dpl_hrc_mark_columns(hrc);
    dpl_hrc_fill_sky(hrc, field);
    DPL_TRY(dpl_hrc_light_faces(hrc, field, margin));
    DPL_TRY(solve_passes(hrc, &frame));
    DPL_TRY(add_ways(hrc));
    hrc->kept = hrc->layout.keeps;
    DPL_TRY(dpl_jobs_run(solver->context, dpl_hrc_finish_task, bands(dpl_field_picture_height(field)), 1,
                         &frame));
    fill_stats(hrc);
    return DPL_OK;
}

static dpl_status solve(dpl_solver *solver, const dpl_field *field, const dpl_targets *targets) {
    dpl_hrc *hrc = (dpl_hrc *)solver;
    dpl_hrc_resolution *resolution = &hrc->resolution;
    if (resolution->kind == DPL_RESOLUTION_FULL)
        return solve_pixels(hrc, field, targets, field->margin);
    DPL_TRY(dpl_hrc_scale_field(resolution, field, targets));
    DPL_TRY(solve_pixels(hrc, &resolution->field, &resolution->targets, field->margin));
    resolution->reflects = hrc->layout.faces;
    DPL_TRY(dpl_hrc_scale_light(resolution, field, targets));
    solver->stats.memory_bytes += dpl_hrc_resolution_bytes(resolution);
    return DPL_OK;
}

const dpl_solver_ops dpl_holographic_ops = {
    .name = "holographic",
    .bytes = sizeof(dpl_hrc),
    .prepare = prepare,
    .solve = solve,
    .release = release,
};
