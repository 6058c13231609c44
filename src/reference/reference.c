/* The truth: from each pixel's centre, uniformly spaced directions, exact traversal of the pixel grid in
 * double precision. It shares nothing with the other solvers but the field, neither distances nor kernels, so
 * that it can judge them. Called through dpl_solver_ops and dpl_reference_solve_pixels().
 *
 * Traversal: Amanatides and Woo 1987, "A fast voxel traversal algorithm for ray tracing". */
#include "job/jobs.h"
#include "solver/solver.h"

#include <math.h>

#define DEFAULT_DIRECTIONS 4096
#define MOST_DIRECTIONS (1 << 20)
static const double PI = 3.14159265358979323846;

typedef struct reference {
    dpl_solver head;
    dpl_buffer directions; /* double[2] per direction: cosine and sine */
    dpl_buffer result;     /* float[3] per pixel, until the solve has succeeded */
} reference;

/* One solve: which pixels, and where their light goes. */
typedef struct gathering {
    const dpl_field *field;
    const double (*directions)[2];
    int32_t direction_count;
    const int32_t (*pixels)[2]; /* NULL: every pixel of the field, row by row */
    float (*rgb)[3];
    dpl_ray_counter counters[DPL_MAX_THREADS];
} gathering;

/* ---- one ray -------------------------------------------------------------------------------------- */

/* Distance along a ray to the first pixel edge in one axis, between edges, and which way the pixel number
 * goes. */
typedef struct axis_walk {
    double next;
    double between;
    int32_t step;
} axis_walk;

static axis_walk walk_from_centre(double direction) {
    if (direction == 0.0)
        return (axis_walk){INFINITY, INFINITY, 0};
    return (axis_walk){0.5 / fabs(direction), 1.0 / fabs(direction), direction < 0.0 ? -1 : 1};
}

static void cross_medium(const dpl_field *field, size_t cell, double length, double radiance[3],
                         double passed[3]) {
    const float *extinction = ((const float(*)[4])field->extinction.data)[cell];
    const float *emission = ((const float(*)[4])field->emission.data)[cell];
    for (int c = 0; c < 3; c++) {
        double absorbed = -expm1(-(double)extinction[c] * length);
        radiance[c] += passed[c] * absorbed * (double)emission[c];
        passed[c] *= 1.0 - absorbed;
    }
}

/* Radiance that arrives at the centre of pixel (x, y) from one direction. */
static void trace_ray(const dpl_field *field, int32_t x, int32_t y, const double direction[2],
                      double radiance[3]) {
    const uint8_t *kind = field->kind.data;
    axis_walk in_x = walk_from_centre(direction[0]), in_y = walk_from_centre(direction[1]);
    double passed[3] = {1.0, 1.0, 1.0}, travelled = 0.0;
    while (x >= 0 && y >= 0 && x < field->width && y < field->height) {
        size_t cell = (size_t)y * (size_t)field->width + (size_t)x;
        bool leaves_by_x = in_x.next < in_y.next;
        double leave = leaves_by_x ? in_x.next : in_y.next;
        if (kind[cell] == DPL_PIXEL_OPAQUE) {
            const float *emission = ((const float(*)[4])field->emission.data)[cell];
            for (int c = 0; c < 3; c++)
                radiance[c] += passed[c] * (double)emission[c];
            return;
        }
        if (kind[cell] == DPL_PIXEL_MEDIUM)
            cross_medium(field, cell, leave - travelled, radiance, passed);
        travelled = leave;
        if (leaves_by_x) {
            x += in_x.step;
            in_x.next += in_x.between;
        } else {
            y += in_y.step;
            in_y.next += in_y.between;
        }
    }
    for (int c = 0; c < 3; c++)
        radiance[c] += passed[c] * (double)field->sky[c];
}

/* ---- pixels --------------------------------------------------------------------------------------- */

/* Mean radiance at one pixel; returns the rays traced. */
static int64_t gather_pixel(const gathering *g, int32_t x, int32_t y, float rgb[3]) {
    double sum[3] = {0.0, 0.0, 0.0};
    if (dpl_field_is_opaque(g->field, x, y)) {
        const float(*emission)[4] = g->field->emission.data;
        memcpy(rgb, emission[(size_t)y * (size_t)g->field->width + (size_t)x], 3 * sizeof(float));
        return 0;
    }
    for (int32_t k = 0; k < g->direction_count; k++)
        trace_ray(g->field, x, y, g->directions[k], sum);
    for (int c = 0; c < 3; c++)
        rgb[c] = (float)(sum[c] / g->direction_count);
    return g->direction_count;
}

static void gather_items(int32_t begin, int32_t end, int32_t worker, void *task) {
    gathering *g = task;
    int64_t rays = 0;
    for (int32_t i = begin; i < end; i++) {
        int32_t x = g->pixels ? g->pixels[i][0] : i % g->field->width;
        int32_t y = g->pixels ? g->pixels[i][1] : i / g->field->width;
        rays += gather_pixel(g, x, y, g->rgb[i]);
    }
    g->counters[worker].rays += rays;
}

static int64_t count_free(const gathering *g, int32_t count) {
    int64_t free_pixels = 0;
    for (int32_t i = 0; i < count; i++) {
        int32_t x = g->pixels ? g->pixels[i][0] : i % g->field->width;
        int32_t y = g->pixels ? g->pixels[i][1] : i / g->field->width;
        free_pixels += !dpl_field_is_opaque(g->field, x, y);
    }
    return free_pixels;
}

static dpl_status gather(reference *r, const dpl_field *field, const int32_t (*pixels)[2], int32_t count,
                         float (*rgb)[3]) {
    gathering g = {
        .field = field,
        .directions = r->directions.data,
        .direction_count = r->head.desc.reference.directions,
        .pixels = pixels,
        .rgb = rgb,
    };
    DPL_TRY(dpl_solver_run(&r->head, gather_items, count, 8, &g, 0.0, 1.0));
    dpl_solver_stats *stats = &r->head.stats;
    memset(stats, 0, sizeof *stats);
    stats->level_count = 1;
    stats->levels[0].probes = count_free(&g, count);
    stats->levels[0].directions = g.direction_count;
    stats->levels[0].full = stats->rays_full = stats->levels[0].probes * g.direction_count;
    stats->levels[0].traced = stats->rays_traced = dpl_ray_counter_sum(g.counters);
    stats->memory_bytes = (int64_t)(r->directions.bytes + r->result.bytes);
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
    DPL_TRY(dpl_buffer_reserve(solver->context, &r->directions, (size_t)*count, 2 * sizeof(double)));
    double(*directions)[2] = r->directions.data;
    for (int32_t k = 0; k < *count; k++) {
        double angle = 2.0 * PI * (k + 0.5) / *count;
        directions[k][0] = cos(angle);
        directions[k][1] = sin(angle);
    }
    return DPL_OK;
}

static dpl_status solve(dpl_solver *solver, const dpl_field *field, const dpl_output *output) {
    reference *r = (reference *)solver;
    size_t pixels = dpl_field_pixels(field);
    DPL_TRY(dpl_buffer_reserve(solver->context, &r->result, pixels, 3 * sizeof(float)));
    DPL_TRY(gather(r, field, NULL, (int32_t)pixels, r->result.data));
    const float(*rgb)[3] = r->result.data;
    for (int32_t y = 0; y < field->height; y++, rgb += field->width)
        dpl_solver_write_pixels(field, output, 0, y, field->width, rgb);
    return DPL_OK;
}

static void release(dpl_solver *solver) {
    reference *r = (reference *)solver;
    dpl_buffer_free(solver->context, &r->directions);
    dpl_buffer_free(solver->context, &r->result);
}

dpl_status dpl_reference_trace_pixels(dpl_solver *solver, const dpl_field *field, const int32_t (*pixels)[2],
                                      int32_t count, float (*rgb)[3]) {
    return gather((reference *)solver, field, pixels, count, rgb);
}

const dpl_solver_ops dpl_reference_ops = {
    .name = "reference",
    .bytes = sizeof(reference),
    .prepare = prepare,
    .solve = solve,
    .release = release,
};
