/* The truth: from each pixel's centre, uniformly spaced directions, each followed exactly (ray.c), in double
 * precision. It shares nothing with the other solvers but the field, neither distances nor kernels, so that
 * it can judge them. With bounces, what walls reflect is worked out first (bounces.c). Called through
 * dpl_solver_ops and dpl_reference_solve_pixels(). */
#include "job/jobs.h"
#include "reference/bounces.h"
#include "reference/light.h"
#include "solver/solver.h"

#include <float.h>
#include <math.h>

#define DEFAULT_DIRECTIONS 4096
#define MOST_DIRECTIONS (1 << 20)
static const double PI = 3.14159265358979323846;

typedef struct reference {
    dpl_solver head;
    dpl_buffer directions; /* dpl_ray_direction each */
    dpl_buffer result;     /* float[3] per pixel of the picture and target, until the solve has succeeded */
    dpl_bounces bounces;   /* in use where the desc asks for bounces */
} reference;

/* What a solve may be asked for, in the order of its planes. */
enum { MEAN, COSINE, SINE, MOST_PLANES };

/* One solve: which pixels, and where their light goes. */
typedef struct gathering {
    dpl_ray_world world;
    const dpl_bounces *bounces;
    const int32_t (*pixels)[2]; /* of the picture; NULL: every one, row by row */
    int32_t count;
    float (*planes[MOST_PLANES])[3]; /* cosine and sine are NULL where only the mean is wanted */
    dpl_ray_counter counters[DPL_MAX_THREADS];
} gathering;

/* ---- pixels --------------------------------------------------------------------------------------- */

/* The world's pixel of an item. */
static void pixel_of_item(const gathering *g, int32_t item, int32_t *x, int32_t *y) {
    const dpl_field *field = g->world.field;
    int32_t width = dpl_field_picture_width(field);
    *x = field->margin + (g->pixels ? g->pixels[item][0] : item % width);
    *y = field->margin + (g->pixels ? g->pixels[item][1] : item / width);
}

/* What arrives at a free pixel, for all planes. */
static void see_from_pixel(const dpl_ray_world *world, int32_t x, int32_t y, double means[MOST_PLANES][3]) {
    for (int32_t k = 0; k < world->direction_count; k++) {
        const dpl_ray_direction *d = &world->directions[k];
        double radiance[3];
        dpl_ray_trace(world, x, y, d, radiance);
        for (int c = 0; c < 3; c++) {
            means[MEAN][c] += radiance[c];
            means[COSINE][c] += radiance[c] * d->unit[0];
            means[SINE][c] += radiance[c] * d->unit[1];
        }
    }
    for (int p = 0; p < MOST_PLANES; p++)
        for (int c = 0; c < 3; c++)
            means[p][c] /= world->direction_count;
}

/* What an opaque pixel shows: its emission, and what it reflects. */
static void show_opaque(const gathering *g, size_t cell, double rgb[3]) {
    const float(*emission)[4] = (const float(*)[4])g->world.field->emission.data;
    for (int c = 0; c < 3; c++)
        rgb[c] = (double)emission[cell][c];
    dpl_bounces_show(g->bounces, &g->world, cell, rgb);
}

/* Bounces between very bright walls may leave the range of a float. */
static float to_float(double value) {
    return (float)fmax(-FLT_MAX, fmin(value, FLT_MAX));
}

/* Fills one item of every plane; returns the rays traced. */
static int64_t gather_item(const gathering *g, int32_t item) {
    double means[MOST_PLANES][3] = {{0.0}};
    int32_t x, y;
    pixel_of_item(g, item, &x, &y);
    bool opaque = dpl_field_is_opaque(g->world.field, x, y);
    if (opaque)
        show_opaque(g, dpl_field_cell(g->world.field, x, y), means[MEAN]);
    else
        see_from_pixel(&g->world, x, y, means);
    for (int p = 0; p < MOST_PLANES; p++)
        for (int c = 0; c < 3 && g->planes[p]; c++)
            g->planes[p][item][c] = to_float(means[p][c]);
    return opaque ? 0 : g->world.direction_count;
}

static void gather_items(int32_t begin, int32_t end, int32_t worker, void *task) {
    gathering *g = task;
    int64_t rays = 0;
    for (int32_t i = begin; i < end; i++)
        rays += gather_item(g, i);
    g->counters[worker].rays += rays;
}

static int64_t count_free(const gathering *g) {
    int64_t free_pixels = 0;
    for (int32_t i = 0; i < g->count; i++) {
        int32_t x, y;
        pixel_of_item(g, i, &x, &y);
        free_pixels += !dpl_field_is_opaque(g->world.field, x, y);
    }
    return free_pixels;
}

/* ---- one solve ------------------------------------------------------------------------------------ */

/* Adds a level to the statistics; nothing is ever skipped. */
static void add_level(dpl_solver_stats *stats, int64_t probes, int32_t directions, int64_t rays) {
    stats->levels[stats->level_count++] = (dpl_level_stats){probes, directions, rays, rays};
    stats->rays_full += rays;
    stats->rays_traced += rays;
}

/* Bounces light between walls, from 0 to `share` of the solve. */
static dpl_status bounce(reference *r, gathering *g, int64_t free_pixels, double *share,
                         dpl_bounces_rays *rays) {
    int32_t times = r->head.desc.bounces;
    DPL_TRY(dpl_bounces_prepare(&r->head, &r->bounces, g->world.field));
    double walls = 0.5 * (double)r->bounces.faces * times; /* a face looks at half a circle */
    *share = walls / (walls + (double)free_pixels + 1.0);
    return dpl_bounces_run(&r->head, &r->bounces, &g->world, times, *share, rays);
}

static dpl_status gather(reference *r, gathering *g) {
    int32_t directions = r->head.desc.reference.directions, times = r->head.desc.bounces;
    int64_t free_pixels = count_free(g);
    dpl_bounces_rays rays = {0};
    double share = 0.0;
    g->world.directions = r->directions.data;
    g->world.direction_count = directions;
    g->bounces = &r->bounces;
    if (times > 0)
        DPL_TRY(bounce(r, g, free_pixels, &share, &rays));
    DPL_TRY(dpl_solver_run(&r->head, gather_items, g->count, 8, g, share, 1.0));
    dpl_solver_stats *stats = &r->head.stats;
    memset(stats, 0, sizeof *stats);
    add_level(stats, free_pixels, directions, dpl_ray_counter_sum(g->counters));
    if (times > 0)
        add_level(stats, r->bounces.faces * times, directions / 2, rays.to_world);
    if (times > 0 && r->head.light_count > 0)
        add_level(stats, r->bounces.faces * r->head.light_count, DPL_LIGHT_RAYS, rays.to_lights);
    stats->memory_bytes = (int64_t)(r->directions.bytes + r->result.bytes) + dpl_bounces_bytes(&r->bounces);
    return DPL_OK;
}

/* ---- the solver ----------------------------------------------------------------------------------- */

static dpl_status prepare(dpl_solver *solver) {
    reference *r = (reference *)solver;
    int32_t *count = &solver->desc.reference.directions;
    if (*count == 0)
        *count = DEFAULT_DIRECTIONS;
    if (*count < 1 || *count > MOST_DIRECTIONS)
        return dpl_fail(solver->context, DPL_ERROR_ARGUMENT, "directions must be 1 .. %d, not %d",
                        MOST_DIRECTIONS, *count);
    DPL_TRY(dpl_buffer_reserve(solver->context, &r->directions, (size_t)*count, sizeof(dpl_ray_direction)));
    dpl_ray_direction *directions = r->directions.data;
    for (int32_t k = 0; k < *count; k++) {
        double angle = 2.0 * PI * (k + 0.5) / *count;
        directions[k] = (dpl_ray_direction){angle, {cos(angle), sin(angle)}};
    }
    return DPL_OK;
}

static dpl_status solve(dpl_solver *solver, const dpl_field *field, const dpl_targets *targets) {
    reference *r = (reference *)solver;
    const dpl_output *outputs[MOST_PLANES] = {&targets->mean, &targets->cosine, &targets->sine};
    int32_t width = dpl_field_picture_width(field), height = dpl_field_picture_height(field);
    int32_t pixels = width * height;
    size_t wanted = targets->cosine.data ? MOST_PLANES : 1;
    DPL_TRY(dpl_buffer_reserve(solver->context, &r->result, wanted * (size_t)pixels, 3 * sizeof(float)));
    gathering g = {.world = {.field = field}, .count = pixels};
    for (size_t p = 0; p < wanted; p++)
        g.planes[p] = (float(*)[3])r->result.data + p * (size_t)pixels;
    DPL_TRY(gather(r, &g));
    for (size_t p = 0; p < wanted; p++)
        for (int32_t y = 0; y < height; y++)
            dpl_solver_write_pixels(field, outputs[p], 0, y, width,
                                    (const float(*)[3])g.planes[p] + (size_t)y * (size_t)width);
    return DPL_OK;
}

static void release(dpl_solver *solver) {
    reference *r = (reference *)solver;
    dpl_buffer_free(solver->context, &r->directions);
    dpl_buffer_free(solver->context, &r->result);
    dpl_bounces_free(solver->context, &r->bounces);
}

dpl_status dpl_reference_trace_pixels(dpl_solver *solver, const dpl_field *field, const int32_t (*pixels)[2],
                                      int32_t count, float (*rgb)[3]) {
    gathering g = {.world = {.field = field}, .pixels = pixels, .count = count, .planes = {rgb}};
    return gather((reference *)solver, &g);
}

const dpl_solver_ops dpl_reference_ops = {
    .name = "reference",
    .bytes = sizeof(reference),
    .reads_clearance = true,
    .prepare = prepare,
    .solve = solve,
    .release = release,
};
