/* Shapes scattered over a square and rays from anywhere in it to anywhere. Called by main.c. */
#include "flat.h"

#include "../common/clock.h"
#include "../common/scatter.h"

#include <stdlib.h>

/* Naive runs ask at most about this many shapes, by tracing fewer rays. */
#define NAIVE_TESTS 8000000
#define NAIVE_RAYS_LEAST 80

const char *const dpl_bench_flat_sets[DPL_BENCH_FLAT_SETS] = {"discs", "boxes"};
static const dpl_shape_kind kinds[DPL_BENCH_FLAT_SETS] = {DPL_SHAPE_DISC, DPL_SHAPE_BOX};

typedef struct dpl_bench_flat_world {
    dpl_bench_flat *flat;
    dpl_tracer *tracer;
} world;

static bool make_rays(dpl_bench_flat *flat, int32_t count, dpl_error *error) {
    flat->rays = malloc((size_t)count * sizeof *flat->rays);
    flat->hits = malloc((size_t)count * sizeof *flat->hits);
    if (!flat->rays || !flat->hits)
        return dpl_error_set(error, "%s", dpl_status_text(DPL_ERROR_MEMORY));
    dpl_bench_scatter_rays(77, count, flat->rays);
    return true;
}

static bool run(dpl_bench_trial *trial, dpl_error *error) {
    world *w = trial->subject;
    dpl_bench_flat *flat = w->flat;
    if (!dpl_bench_good(dpl_tracer_trace(w->tracer, flat->rays, trial->rays, flat->hits), flat->context,
                        error))
        return false;
    trial->hits = 0;
    for (int64_t i = 0; i < trial->rays; i++)
        trial->hits += flat->hits[i].object >= 0;
    return dpl_bench_trial_count(trial, w->tracer, error);
}

/* A fresh tracer for each build, as a second one would only be refitted. The last is kept. */
static bool build(world *w, dpl_tracer_method method, const dpl_shape *shapes, int32_t count,
                  dpl_bench_summary *ms, int32_t builds, dpl_error *error) {
    double times[DPL_BENCH_MAX_ROUNDS];
    dpl_context *context = w->flat->context;
    dpl_tracer_desc desc = dpl_tracer_desc_default();
    desc.method = method;
    for (int32_t i = 0; i < builds; i++) {
        dpl_tracer_destroy(w->tracer);
        w->tracer = NULL;
        if (!dpl_bench_good(dpl_tracer_create(context, &desc, &w->tracer), context, error))
            return false;
        dpl_bench_time start = dpl_bench_now();
        dpl_status status = dpl_tracer_set_shapes(w->tracer, DPL_TRACER_STATIC, shapes, count);
        times[i] = dpl_bench_since(start).cpu_ms;
        if (!dpl_bench_good(status, context, error))
            return false;
    }
    *ms = dpl_bench_summarise(times, builds);
    dpl_tracer_reset_stats(w->tracer);
    return true;
}

static int64_t naive_rays(int32_t objects, int32_t rays) {
    int64_t count = NAIVE_TESTS / objects;
    count = count < NAIVE_RAYS_LEAST ? NAIVE_RAYS_LEAST : count;
    return count < rays ? count : rays;
}

static bool add(dpl_bench_flat *flat, int32_t set, int32_t objects, int32_t rays, int32_t builds,
                dpl_bench_trials *trials, dpl_error *error) {
    dpl_shape *shapes = dpl_bench_scatter_shapes(kinds[set], objects, (uint64_t)set);
    bool good = shapes || dpl_error_set(error, "%s", dpl_status_text(DPL_ERROR_MEMORY));
    for (int method = DPL_TRACER_BVH; good && method <= DPL_TRACER_NAIVE; method++) {
        world *w = &flat->worlds[flat->count++];
        dpl_bench_trial *trial = dpl_bench_trials_add(trials, error);
        w->flat = flat;
        good = trial && build(w, (dpl_tracer_method)method, shapes, objects, &trial->build_ms, builds, error);
        if (!good)
            break;
        trial->part = "flat";
        trial->set = dpl_bench_flat_sets[set];
        trial->query = "closest";
        trial->method = dpl_tracer_method_name((dpl_tracer_method)method);
        trial->objects = objects;
        trial->rays = method == DPL_TRACER_NAIVE ? naive_rays(objects, rays) : rays;
        trial->run = run;
        trial->subject = w;
    }
    free(shapes);
    return good;
}

bool dpl_bench_flat_prepare(dpl_bench_flat *flat, dpl_context *context, int32_t largest, int32_t rays,
                            int32_t builds, dpl_bench_trials *trials, dpl_error *error) {
    int32_t sizes = 0;
    for (int32_t size = 1; size <= largest; size = dpl_bench_next_size(size))
        sizes++;
    flat->context = context;
    flat->worlds = calloc((size_t)(2 * DPL_BENCH_FLAT_SETS * sizes), sizeof *flat->worlds);
    if (!flat->worlds)
        return dpl_error_set(error, "%s", dpl_status_text(DPL_ERROR_MEMORY));
    if (!make_rays(flat, rays, error))
        return false;
    for (int32_t set = 0; set < DPL_BENCH_FLAT_SETS; set++)
        for (int32_t size = 1; size <= largest; size = dpl_bench_next_size(size))
            if (!add(flat, set, size, rays, builds, trials, error))
                return false;
    return true;
}

void dpl_bench_flat_free(dpl_bench_flat *flat) {
    for (int32_t i = 0; i < flat->count; i++)
        dpl_tracer_destroy(flat->worlds[i].tracer);
    free(flat->worlds);
    free(flat->rays);
    free(flat->hits);
    *flat = (dpl_bench_flat){0};
}
