/* Layers of objects, and batches of rays through both. Called by src/api/tracer.c with checked arguments. */
#include "tracer/tracer.h"

#include "field/field.h"
#include "job/jobs.h"

/* Rays that a worker takes at once. */
#define BATCH 256

/* ---- layers --------------------------------------------------------------------------------------- */

/* The static layer's numbers come first. Whatever was seen of it before is out of date. */
static void layer_changed(dpl_tracer *tracer, dpl_tracer_layer layer) {
    tracer->shapes[DPL_TRACER_DYNAMIC].first_object = tracer->shapes[DPL_TRACER_STATIC].count;
    tracer->triangles[DPL_TRACER_DYNAMIC].first_object = tracer->triangles[DPL_TRACER_STATIC].count;
    if (layer == DPL_TRACER_STATIC)
        tracer->kept_picture = (dpl_kept_picture){0};
}

static dpl_status keep_emission(dpl_tracer *tracer, dpl_tracer_layer layer, const dpl_shape *shapes,
                                int32_t count) {
    dpl_buffer *buffer = &tracer->emission[layer];
    DPL_TRY(dpl_buffer_reserve(tracer->context, buffer, (size_t)count, 3 * sizeof(float)));
    float(*emission)[3] = buffer->data;
    tracer->not_opaque[layer] = -1;
    for (int32_t i = 0; i < count; i++) {
        memcpy(emission[i], shapes[i].material.emission, sizeof emission[i]);
        if (tracer->not_opaque[layer] < 0 && dpl_material_kind(&shapes[i].material) != DPL_PIXEL_OPAQUE)
            tracer->not_opaque[layer] = i;
    }
    return DPL_OK;
}

dpl_status dpl_tracer_keep_shapes(dpl_tracer *tracer, dpl_tracer_layer layer, const dpl_shape *shapes,
                                  int32_t count) {
    dpl_shapes *set = &tracer->shapes[layer];
    set->count = 0;
    tracer->not_opaque[layer] = -1;
    dpl_status status = keep_emission(tracer, layer, shapes, count);
    if (status == DPL_OK)
        status = dpl_shapes_set(tracer->context, set, shapes, count, tracer->desc.method == DPL_TRACER_BVH);
    layer_changed(tracer, layer);
    return status;
}

dpl_status dpl_tracer_keep_triangles(dpl_tracer *tracer, dpl_tracer_layer layer,
                                     const dpl_triangles_source *source) {
    dpl_status status = dpl_triangles_set(tracer->context, &tracer->triangles[layer], source,
                                          tracer->desc.method == DPL_TRACER_BVH);
    layer_changed(tracer, layer);
    return status;
}

/* ---- rays ----------------------------------------------------------------------------------------- */

typedef struct batch {
    const dpl_tracer *tracer;
    const dpl_ray *rays;
    int64_t count;
    dpl_hit *hits;
    uint8_t *occluded;
    dpl_tracer_worker workers[DPL_MAX_THREADS];
} batch;

static dpl_hit closest_of_layers(const dpl_tracer *tracer, const dpl_ray *ray, dpl_walk_counts *counts) {
    dpl_hit hit = dpl_hit_none();
    for (int layer = 0; layer < DPL_TRACER_LAYERS; layer++) {
        if (tracer->shapes[layer].count > 0)
            dpl_shapes_closest(&tracer->shapes[layer], ray, &hit, counts);
        if (tracer->triangles[layer].count > 0)
            dpl_triangles_closest(&tracer->triangles[layer], ray, &hit, counts);
    }
    return hit;
}

static bool occluded_by_layers(const dpl_tracer *tracer, const dpl_ray *ray, dpl_walk_counts *counts) {
    for (int layer = 0; layer < DPL_TRACER_LAYERS; layer++)
        if ((tracer->shapes[layer].count > 0 && dpl_shapes_occluded(&tracer->shapes[layer], ray, counts)) ||
            (tracer->triangles[layer].count > 0 &&
             dpl_triangles_occluded(&tracer->triangles[layer], ray, counts)))
            return true;
    return false;
}

static void trace_items(int32_t begin, int32_t end, int32_t worker, void *task) {
    batch *b = task;
    dpl_tracer_counts *counts = &b->workers[worker].counts;
    int64_t first = (int64_t)begin * BATCH, last = (int64_t)end * BATCH;
    last = last < b->count ? last : b->count;
    for (int64_t i = first; i < last; i++) {
        if (b->hits)
            b->hits[i] = closest_of_layers(b->tracer, &b->rays[i], &counts->walks);
        else
            b->occluded[i] = occluded_by_layers(b->tracer, &b->rays[i], &counts->walks);
    }
    counts->rays += last - first;
    counts->static_rays += last - first;
}

dpl_status dpl_tracer_trace_batch(dpl_tracer *tracer, const dpl_ray *rays, int64_t count, dpl_hit *hits,
                                  uint8_t *occluded) {
    batch b = {.tracer = tracer, .rays = rays, .count = count, .hits = hits, .occluded = occluded};
    int32_t items = (int32_t)((count + BATCH - 1) / BATCH);
    DPL_TRY(dpl_jobs_run(tracer->context, trace_items, items, 1, &b));
    dpl_tracer_add_counts(tracer, b.workers);
    return DPL_OK;
}

void dpl_tracer_add_counts(dpl_tracer *tracer, const dpl_tracer_worker workers[DPL_MAX_THREADS]) {
    dpl_tracer_counts *sum = &tracer->counts;
    for (int i = 0; i < DPL_MAX_THREADS; i++) {
        const dpl_tracer_counts *counts = &workers[i].counts;
        sum->walks.object_tests += counts->walks.object_tests;
        sum->walks.node_visits += counts->walks.node_visits;
        sum->rays += counts->rays;
        sum->static_rays += counts->static_rays;
    }
}
