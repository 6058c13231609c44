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

typedef struct ray_direction {
    double angle;
    double unit[2]; /* cosine and sine */
} ray_direction;

typedef struct reference {
    dpl_solver head;
    dpl_buffer directions; /* `ray_direction` each */
    dpl_buffer result;     /* float[3] per pixel of the picture and target, until the solve has succeeded */
} reference;

/* What a solve may be asked for, in the order of its planes. */
enum { MEAN, COSINE, SINE, MOST_PLANES };

/* One solve: which pixels, and where their light goes. */
typedef struct gathering {
    const dpl_field *field;
    const ray_direction *directions;
    int32_t direction_count;
    const int32_t (*pixels)[2];      /* of the picture; NULL: every one, row by row */
    float (*planes[MOST_PLANES])[3]; /* cosine and sine are NULL where only the mean is wanted */
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

/* Radiance that arrives at the centre of the world's pixel (x, y) from one direction. */
static void trace_ray(const dpl_field *field, int32_t x, int32_t y, const ray_direction *d,
                      double radiance[3]) {
    const uint8_t *kind = field->kind.data;
    axis_walk in_x = walk_from_centre(d->unit[0]), in_y = walk_from_centre(d->unit[1]);
    for (int c = 0; c < 3; c++)
        radiance[c] = 0.0;
    double passed[3] = {1.0, 1.0, 1.0}, travelled = 0.0;
    while (x >= 0 && y >= 0 && x < field->width && y < field->height) {
        size_t cell = dpl_field_cell(field, x, y);
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
    const float *sky = dpl_field_sky_at(field, d->angle);
    for (int c = 0; c < 3; c++)
        radiance[c] += passed[c] * (double)sky[c];
}

/* ---- pixels --------------------------------------------------------------------------------------- */

/* The world's pixel of an item. */
static void pixel_of_item(const gathering *g, int32_t item, int32_t *x, int32_t *y) {
    int32_t width = dpl_field_picture_width(g->field);
    *x = g->field->margin + (g->pixels ? g->pixels[item][0] : item % width);
    *y = g->field->margin + (g->pixels ? g->pixels[item][1] : item / width);
}

/* Sums of what arrives at a free pixel, for all planes that are wanted. */
static void sum_pixel(const gathering *g, int32_t x, int32_t y, double sums[MOST_PLANES][3]) {
    for (int32_t k = 0; k < g->direction_count; k++) {
        const ray_direction *d = &g->directions[k];
        double radiance[3];
        trace_ray(g->field, x, y, d, radiance);
        for (int c = 0; c < 3; c++) {
            sums[MEAN][c] += radiance[c];
            sums[COSINE][c] += radiance[c] * d->unit[0];
            sums[SINE][c] += radiance[c] * d->unit[1];
        }
    }
}

/* Fills one item of every plane; returns the rays traced. */
static int64_t gather_item(const gathering *g, int32_t item) {
    double sums[MOST_PLANES][3] = {{0.0}};
    int32_t x, y;
    pixel_of_item(g, item, &x, &y);
    bool opaque = dpl_field_is_opaque(g->field, x, y);
    if (!opaque)
        sum_pixel(g, x, y, sums);
    for (int p = 0; p < MOST_PLANES; p++)
        for (int c = 0; c < 3 && g->planes[p]; c++)
            g->planes[p][item][c] = (float)(sums[p][c] / g->direction_count);
    if (opaque) {
        const float(*emission)[4] = (const float(*)[4])g->field->emission.data;
        memcpy(g->planes[MEAN][item], emission[dpl_field_cell(g->field, x, y)], 3 * sizeof(float));
    }
    return opaque ? 0 : g->direction_count;
}

static void gather_items(int32_t begin, int32_t end, int32_t worker, void *task) {
    gathering *g = task;
    int64_t rays = 0;
    for (int32_t i = begin; i < end; i++)
        rays += gather_item(g, i);
    g->counters[worker].rays += rays;
}

static int64_t count_free(const gathering *g, int32_t count) {
    int64_t free_pixels = 0;
    for (int32_t i = 0; i < count; i++) {
        int32_t x, y;
        pixel_of_item(g, i, &x, &y);
        free_pixels += !dpl_field_is_opaque(g->field, x, y);
    }
    return free_pixels;
}

static dpl_status gather(reference *r, gathering *g, int32_t count) {
    g->directions = r->directions.data;
    g->direction_count = r->head.desc.reference.directions;
    DPL_TRY(dpl_solver_run(&r->head, gather_items, count, 8, g, 0.0, 1.0));
    dpl_solver_stats *stats = &r->head.stats;
    memset(stats, 0, sizeof *stats);
    stats->level_count = 1;
    stats->levels[0].probes = count_free(g, count);
    stats->levels[0].directions = g->direction_count;
    stats->levels[0].full = stats->rays_full = stats->levels[0].probes * g->direction_count;
    stats->levels[0].traced = stats->rays_traced = dpl_ray_counter_sum(g->counters);
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
    if (solver->desc.bounces > 0)
        return dpl_fail(solver->context, DPL_ERROR_ARGUMENT, "reference: light does not bounce yet");
    DPL_TRY(dpl_buffer_reserve(solver->context, &r->directions, (size_t)*count, sizeof(ray_direction)));
    ray_direction *directions = r->directions.data;
    for (int32_t k = 0; k < *count; k++) {
        double angle = 2.0 * PI * (k + 0.5) / *count;
        directions[k] = (ray_direction){angle, {cos(angle), sin(angle)}};
    }
    return DPL_OK;
}

/* One target from its plane of float[3] per pixel of the picture. */
static void write_target(const dpl_field *field, const dpl_output *output, const float (*rgb)[3]) {
    for (int32_t y = 0; y < dpl_field_picture_height(field); y++) {
        float *out = (float *)(void *)((char *)output->data + output->row_stride * y);
        for (int32_t x = 0; x < dpl_field_picture_width(field); x++, rgb++, out += output->channels) {
            memcpy(out, *rgb, sizeof *rgb);
            if (output->channels == 4)
                out[3] = 1.0f;
        }
    }
}

static dpl_status solve(dpl_solver *solver, const dpl_field *field, const dpl_targets *targets) {
    reference *r = (reference *)solver;
    const dpl_output *outputs[MOST_PLANES] = {&targets->mean, &targets->cosine, &targets->sine};
    int32_t pixels = dpl_field_picture_width(field) * dpl_field_picture_height(field);
    size_t wanted = targets->cosine.data ? MOST_PLANES : 1;
    DPL_TRY(dpl_buffer_reserve(solver->context, &r->result, wanted * (size_t)pixels, 3 * sizeof(float)));
    gathering g = {.field = field};
    for (size_t p = 0; p < wanted; p++)
        g.planes[p] = (float(*)[3])r->result.data + p * (size_t)pixels;
    DPL_TRY(gather(r, &g, pixels));
    for (size_t p = 0; p < wanted; p++)
        write_target(field, outputs[p], (const float(*)[3])g.planes[p]);
    return DPL_OK;
}

static void release(dpl_solver *solver) {
    reference *r = (reference *)solver;
    dpl_buffer_free(solver->context, &r->directions);
    dpl_buffer_free(solver->context, &r->result);
}

dpl_status dpl_reference_trace_pixels(dpl_solver *solver, const dpl_field *field, const int32_t (*pixels)[2],
                                      int32_t count, float (*rgb)[3]) {
    gathering g = {.field = field, .pixels = pixels, .planes = {rgb}};
    return gather((reference *)solver, &g, count);
}

const dpl_solver_ops dpl_reference_ops = {
    .name = "reference",
    .bytes = sizeof(reference),
    .prepare = prepare,
    .solve = solve,
    .release = release,
};
