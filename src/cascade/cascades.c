/* Solver "cascades": plans the levels, solves them top down with two buffers of radiance, and brings level 0
 * to pixels. Called through dpl_solver_ops. */
#include "cascade/level.h"
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

/* ---- from probes to pixels ------------------------------------------------------------------------------
 */

typedef struct output_task {
    const cascades *c;
    const dpl_field *field;
    const dpl_output *output;
} output_task;

/* Mean over the slots of level 0 at one probe. */
static float probe_mean(const cascades *c, int channel, int32_t probe_x, int32_t probe_y) {
    const dpl_schedule_level *level = &c->schedule.levels[0];
    const float *radiance = c->radiance[0].data;
    float sum = 0.0f;
    for (int32_t slot = 0; slot < level->slots; slot++)
        sum += radiance[dpl_level_row(level, slot, channel, probe_y) + (size_t)probe_x];
    return sum / (float)level->slots;
}

/* Does the probe stand in an opaque pixel? Such a probe sees nothing but that pixel. */
static bool probe_is_buried(const dpl_field *field, const dpl_schedule_level *level, int32_t probe_x,
                            int32_t probe_y) {
    int32_t x = (int32_t)((probe_x + 0.5) * level->spacing), y = (int32_t)((probe_y + 0.5) * level->spacing);
    if (x >= field->width || y >= field->height)
        return false;
    const uint8_t *kind = field->kind.data;
    return kind[(size_t)y * (size_t)field->width + (size_t)x] == DPL_PIXEL_OPAQUE;
}

/* Two neighbouring probes and the share of the second, for a pixel along one axis. */
typedef struct neighbours {
    int32_t probe[2];
    float share[2];
} neighbours;

static neighbours neighbours_of(int32_t pixel, double spacing, int32_t count) {
    double u = (pixel + 0.5) / spacing - 0.5;
    int32_t low = (int32_t)floor(u);
    float upper = (float)(u - floor(u));
    neighbours n = {{low < 0 ? 0 : low, low + 1 >= count ? count - 1 : low + 1}, {1.0f - upper, upper}};
    return n;
}

/* Bilinear over the four probes around a pixel, leaving out those that are buried in walls. */
static void interpolate_pixel(const output_task *task, int32_t x, int32_t y, float rgb[3]) {
    const dpl_schedule_level *level = &task->c->schedule.levels[0];
    neighbours in_x = neighbours_of(x, level->spacing, level->probes_x);
    neighbours in_y = neighbours_of(y, level->spacing, level->probes_y);
    float total = 0.0f;
    rgb[0] = rgb[1] = rgb[2] = 0.0f;
    for (int i = 0; i < 4; i++) {
        int32_t probe_x = in_x.probe[i & 1], probe_y = in_y.probe[i >> 1];
        float weight = in_x.share[i & 1] * in_y.share[i >> 1];
        if (weight == 0.0f || probe_is_buried(task->field, level, probe_x, probe_y))
            continue;
        total += weight;
        for (int c = 0; c < 3; c++)
            rgb[c] += weight * probe_mean(task->c, c, probe_x, probe_y);
    }
    for (int c = 0; c < 3 && total > 0.0f; c++)
        rgb[c] /= total;
}

static void write_rows(int32_t begin, int32_t end, int32_t worker, void *task) {
    const output_task *t = task;
    const cascades *c = t->c;
    size_t width = (size_t)t->field->width;
    float *planes[3];
    for (int p = 0; p < 3; p++)
        planes[p] = (float *)c->rows.data + ((size_t)worker * 3 + (size_t)p) * width;
    for (int32_t y = begin; y < end; y++) {
        for (int32_t x = 0; x < t->field->width; x++) {
            float rgb[3];
            interpolate_pixel(t, x, y, rgb);
            for (int p = 0; p < 3; p++)
                planes[p][x] = rgb[p];
        }
        dpl_solver_write_row(t->field, t->output, y, (const float *const *)planes);
    }
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
    output_task task = {c, field, output};
    return dpl_jobs_run(solver->context, write_rows, field->height, 8, &task);
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
