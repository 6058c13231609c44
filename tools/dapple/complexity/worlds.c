/* Makes and frees what is measured. */
#include "worlds.h"

#include "bench/common/scatter.h"

#include <stdlib.h>
#include <string.h>

/* Naive runs test at most this many objects: a run should not take more than a third of a second. */
#define NAIVE_TESTS_MAX 1e8
#define CROSSOVER_LARGEST 16
#define CROSSOVER_RAYS 3000
/* The rays must not be the numbers that the objects were made from. */
#define RAY_SEED 77
/* Light that loses this much with a step reaches the corners of the largest world. */
#define LAMP_STEP 4

const int32_t dpl_complexity_ray_counts[DPL_COMPLEXITY_RAY_COUNTS] = {100, 300, 1000, 3000, 10000};

static dpl_complexity_case *add_case(dpl_complexity_worlds *worlds, dpl_complexity_method method,
                                     dpl_complexity_part part, int32_t size, int32_t rays, void *world) {
    dpl_complexity_case *c = &worlds->cases[worlds->case_count++];
    c->method = method;
    c->part = part;
    c->size = size;
    c->rays = rays;
    c->world = world;
    return c;
}

/* ---- rays ----------------------------------------------------------------------------------------- */

static dpl_status make_tracer(dpl_complexity_worlds *worlds, const dpl_shape *shapes, int32_t objects,
                              dpl_complexity_method method, dpl_tracer **tracer) {
    dpl_tracer_desc desc = dpl_tracer_desc_default();
    desc.method = method == DPL_COMPLEXITY_NAIVE ? DPL_TRACER_NAIVE : DPL_TRACER_BVH;
    dpl_status status = dpl_tracer_create(worlds->context, &desc, tracer);
    if (status != DPL_OK)
        return status;
    worlds->tracers[worlds->tracer_count++] = *tracer;
    return dpl_tracer_set_shapes(*tracer, DPL_TRACER_STATIC, shapes, objects);
}

static void add_rays(dpl_complexity_worlds *worlds, dpl_complexity_method method, dpl_complexity_part part,
                     int32_t objects, dpl_tracer *tracer) {
    if (part == DPL_COMPLEXITY_CROSSOVER) {
        add_case(worlds, method, part, objects, CROSSOVER_RAYS, tracer);
        return;
    }
    for (int i = 0; i < DPL_COMPLEXITY_RAY_COUNTS; i++) {
        int32_t rays = dpl_complexity_ray_counts[i];
        if (method == DPL_COMPLEXITY_BVH || (double)rays * objects <= NAIVE_TESTS_MAX)
            add_case(worlds, method, part, objects, rays, tracer);
    }
}

/* The same objects for both methods. */
static dpl_status add_objects(dpl_complexity_worlds *worlds, dpl_complexity_part part, int32_t objects) {
    dpl_shape *shapes = dpl_bench_scatter_shapes(DPL_SHAPE_DISC, objects, worlds->plan->seed);
    dpl_status status = shapes ? DPL_OK : DPL_ERROR_MEMORY;
    for (int method = DPL_COMPLEXITY_NAIVE; method <= DPL_COMPLEXITY_BVH && status == DPL_OK; method++) {
        dpl_tracer *tracer;
        status = make_tracer(worlds, shapes, objects, (dpl_complexity_method)method, &tracer);
        if (status == DPL_OK)
            add_rays(worlds, (dpl_complexity_method)method, part, objects, tracer);
    }
    free(shapes);
    return status;
}

static dpl_status add_tracers(dpl_complexity_worlds *worlds) {
    const int32_t rays = dpl_complexity_ray_counts[DPL_COMPLEXITY_RAY_COUNTS - 1];
    worlds->rays = malloc((size_t)rays * sizeof *worlds->rays);
    worlds->hits = malloc((size_t)rays * sizeof *worlds->hits);
    if (!worlds->rays || !worlds->hits)
        return DPL_ERROR_MEMORY;
    dpl_bench_scatter_rays(worlds->plan->seed + RAY_SEED, rays, worlds->rays);
    dpl_status status = DPL_OK;
    for (int32_t n = 1; n <= worlds->plan->largest && status == DPL_OK; n = dpl_bench_next_size(n))
        status = add_objects(worlds, DPL_COMPLEXITY_GROWTH, n);
    for (int32_t n = 1; n <= CROSSOVER_LARGEST && status == DPL_OK; n++)
        status = add_objects(worlds, DPL_COMPLEXITY_CROSSOVER, n);
    return status;
}

/* ---- floods --------------------------------------------------------------------------------------- */

/* An open world: a lamp in the middle whose light reaches every corner, so that each cell is visited. */
static dpl_status add_flood(dpl_complexity_worlds *worlds, int32_t side) {
    const uint16_t full[DPL_FLOOD_MAX_CHANNELS] = {DPL_FLOOD_FULL, DPL_FLOOD_FULL, DPL_FLOOD_FULL,
                                                   DPL_FLOOD_FULL};
    dpl_flood_desc desc = dpl_flood_desc_default();
    dpl_flood_light light;
    dpl_flood *flood;
    desc.width = desc.height = side;
    desc.step = LAMP_STEP;
    dpl_status status = dpl_flood_create(worlds->context, &desc, &flood);
    if (status != DPL_OK)
        return status;
    worlds->floods[worlds->flood_count++] = flood;
    add_case(worlds, DPL_COMPLEXITY_FLOOD, DPL_COMPLEXITY_GROWTH, side, 0, flood);
    return dpl_flood_add_light(flood, side / 2, side / 2, 0, full, &light);
}

dpl_status dpl_complexity_worlds_create(const dpl_complexity_plan *plan, dpl_complexity_worlds *worlds) {
    dpl_context_desc desc = dpl_context_desc_default();
    desc.thread_count = plan->threads;
    worlds->plan = plan;
    worlds->cases = calloc(DPL_COMPLEXITY_CASES_MAX, sizeof *worlds->cases);
    dpl_status status = worlds->cases ? dpl_context_create(&desc, &worlds->context) : DPL_ERROR_MEMORY;
    if (status == DPL_OK)
        status = add_tracers(worlds);
    for (int32_t side = DPL_COMPLEXITY_SIDE_MIN; side <= plan->side && status == DPL_OK; side *= 2)
        status = add_flood(worlds, side);
    return status;
}

void dpl_complexity_worlds_destroy(dpl_complexity_worlds *worlds) {
    for (int32_t i = 0; i < worlds->tracer_count; i++)
        dpl_tracer_destroy(worlds->tracers[i]);
    for (int32_t i = 0; i < worlds->flood_count; i++)
        dpl_flood_destroy(worlds->floods[i]);
    free(worlds->rays);
    free(worlds->hits);
    free(worlds->cases);
    dpl_context_destroy(worlds->context);
    memset(worlds, 0, sizeof *worlds);
}

const dpl_complexity_case *dpl_complexity_find(const dpl_complexity_worlds *worlds,
                                               dpl_complexity_method method, int32_t size, int32_t rays) {
    for (int32_t i = 0; i < worlds->case_count; i++) {
        const dpl_complexity_case *c = &worlds->cases[i];
        if (c->part == DPL_COMPLEXITY_GROWTH && c->method == method && c->size == size && c->rays == rays)
            return c;
    }
    return NULL;
}
