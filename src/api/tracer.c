/* The public face of tracers: argument checks, making and freeing, counters. */
#include "tracer/tracer.h"
#include "api/output_fault.h"

#include "api/shape_fault.h"
#include "base/desc.h"

#include <math.h>

#define MOST_DIRECTIONS (1 << 20)
#define MOST_SIZE 16384
#define HIGHEST_COORDINATE 1e9f

static const char *const method_names[] = {"bvh", "naive"};

const char *dpl_tracer_method_name(dpl_tracer_method method) {
    return method == DPL_TRACER_BVH || method == DPL_TRACER_NAIVE ? method_names[method] : "?";
}

/* ---- making and freeing --------------------------------------------------------------------------- */

dpl_status dpl_tracer_create(dpl_context *context, const dpl_tracer_desc *desc, dpl_tracer **out) {
    if (!context || !desc || !out)
        return DPL_ERROR_ARGUMENT;
    *out = NULL;
    if (!DPL_DESC_IS_GOOD(desc))
        return dpl_fail(context, DPL_ERROR_DESC, "the tracer desc was not made by dpl_tracer_desc_default()");
    if (desc->geometry != DPL_TRACER_SHAPES && desc->geometry != DPL_TRACER_TRIANGLES)
        return dpl_fail(context, DPL_ERROR_ARGUMENT, "there is no geometry %d", (int)desc->geometry);
    if (desc->method != DPL_TRACER_BVH && desc->method != DPL_TRACER_NAIVE)
        return dpl_fail(context, DPL_ERROR_ARGUMENT, "there is no way %d to trace", (int)desc->method);
    dpl_tracer *tracer = dpl_allocate(context, 1, sizeof *tracer);
    if (!tracer)
        return DPL_ERROR_MEMORY;
    memset(tracer, 0, sizeof *tracer);
    tracer->context = context;
    tracer->desc = *desc;
    *out = tracer;
    return DPL_OK;
}

void dpl_tracer_destroy(dpl_tracer *tracer) {
    if (!tracer)
        return;
    dpl_context *context = tracer->context;
    for (int layer = 0; layer < DPL_TRACER_LAYERS; layer++) {
        dpl_shapes_free(context, &tracer->shapes[layer]);
        dpl_triangles_free(context, &tracer->triangles[layer]);
        dpl_buffer_free(context, &tracer->emission[layer]);
    }
    dpl_buffer_free(context, &tracer->directions);
    dpl_buffer_free(context, &tracer->kept);
    dpl_release(context, tracer, 1, sizeof *tracer);
}

/* ---- objects -------------------------------------------------------------------------------------- */

static dpl_status check_layer(const dpl_tracer *tracer, dpl_tracer_geometry geometry, dpl_tracer_layer layer,
                              int32_t count) {
    static const char *const names[] = {"shapes", "triangles"};
    if (tracer->desc.geometry != geometry)
        return dpl_fail(tracer->context, DPL_ERROR_ARGUMENT, "this tracer traces %s, not %s",
                        names[tracer->desc.geometry], names[geometry]);
    if (layer != DPL_TRACER_STATIC && layer != DPL_TRACER_DYNAMIC)
        return dpl_fail(tracer->context, DPL_ERROR_ARGUMENT, "there is no layer %d", (int)layer);
    if (count > DPL_MAX_TRACED_OBJECTS)
        return dpl_fail(tracer->context, DPL_ERROR_SIZE, "a layer holds 0 .. %d objects, not %d",
                        DPL_MAX_TRACED_OBJECTS, count);
    return DPL_OK;
}

dpl_status dpl_tracer_set_shapes(dpl_tracer *tracer, dpl_tracer_layer layer, const dpl_shape *shapes,
                                 int32_t count) {
    if (!tracer || count < 0 || (!shapes && count > 0))
        return DPL_ERROR_ARGUMENT;
    DPL_TRY(check_layer(tracer, DPL_TRACER_SHAPES, layer, count));
    for (int32_t i = 0; i < count; i++) {
        const char *fault = dpl_shape_fault(&shapes[i]);
        if (fault)
            return dpl_fail(tracer->context, DPL_ERROR_ARGUMENT, "shape %d: %s", i, fault);
    }
    return dpl_tracer_keep_shapes(tracer, layer, shapes, count);
}

dpl_status dpl_tracer_set_triangles(dpl_tracer *tracer, dpl_tracer_layer layer, const float (*vertices)[3],
                                    int32_t vertex_count, const int32_t (*indices)[3], int32_t count) {
    if (!tracer || count < 0 || vertex_count < 0 || (!vertices && vertex_count > 0) ||
        (!indices && count > 0))
        return DPL_ERROR_ARGUMENT;
    DPL_TRY(check_layer(tracer, DPL_TRACER_TRIANGLES, layer, count));
    for (int32_t i = 0; i < vertex_count; i++)
        for (int axis = 0; axis < 3; axis++)
            if (!(fabsf(vertices[i][axis]) <= HIGHEST_COORDINATE))
                return dpl_fail(tracer->context, DPL_ERROR_ARGUMENT,
                                "corner %d: coordinates must be finite and within 1e9", i);
    for (int32_t i = 0; i < count; i++)
        for (int k = 0; k < 3; k++)
            if (indices[i][k] < 0 || indices[i][k] >= vertex_count)
                return dpl_fail(tracer->context, DPL_ERROR_ARGUMENT,
                                "triangle %d: there is no corner %d among %d", i, indices[i][k],
                                vertex_count);
    dpl_triangles_source source = {vertices, indices, count};
    return dpl_tracer_keep_triangles(tracer, layer, &source);
}

/* ---- rays ----------------------------------------------------------------------------------------- */

dpl_status dpl_tracer_trace(dpl_tracer *tracer, const dpl_ray *rays, int64_t count, dpl_hit *hits) {
    if (!tracer || count < 0 || (count > 0 && (!rays || !hits)))
        return DPL_ERROR_ARGUMENT;
    return count == 0 ? DPL_OK : dpl_tracer_trace_batch(tracer, rays, count, hits, NULL);
}

dpl_status dpl_tracer_occluded(dpl_tracer *tracer, const dpl_ray *rays, int64_t count, uint8_t *occluded) {
    if (!tracer || count < 0 || (count > 0 && (!rays || !occluded)))
        return DPL_ERROR_ARGUMENT;
    return count == 0 ? DPL_OK : dpl_tracer_trace_batch(tracer, rays, count, NULL, occluded);
}

/* ---- pictures ------------------------------------------------------------------------------------- */

static dpl_status check_output(const dpl_tracer *tracer, dpl_output *output) {
    dpl_context *context = tracer->context;
    if (output->width < 1 || output->height < 1 || output->width > MOST_SIZE || output->height > MOST_SIZE)
        return dpl_fail(context, DPL_ERROR_SIZE, "the output is %d x %d, not 1 .. %d a side", output->width,
                        output->height, MOST_SIZE);
    dpl_output_rules rules = {output->width, output->height, "picture", false};
    return dpl_output_check(context, &rules, output);
}

static dpl_status check_light(const dpl_tracer *tracer, const dpl_tracer_light_desc *desc) {
    dpl_context *context = tracer->context;
    if (!DPL_DESC_IS_GOOD(desc))
        return dpl_fail(context, DPL_ERROR_DESC,
                        "the light desc was not made by dpl_tracer_light_desc_default()");
    if (desc->directions < 1 || desc->directions > MOST_DIRECTIONS)
        return dpl_fail(context, DPL_ERROR_ARGUMENT, "directions must be 1 .. %d, not %d", MOST_DIRECTIONS,
                        desc->directions);
    if (!colour_is_good(desc->sky, HIGHEST_RADIANCE))
        return dpl_fail(context, DPL_ERROR_ARGUMENT, "the sky must be finite and not negative");
    if (tracer->desc.geometry != DPL_TRACER_SHAPES)
        return dpl_fail(context, DPL_ERROR_ARGUMENT, "only shapes light a picture, not triangles");
    for (int layer = 0; layer < DPL_TRACER_LAYERS; layer++)
        if (tracer->not_opaque[layer] >= 0 && tracer->shapes[layer].count > 0)
            return dpl_fail(context, DPL_ERROR_ARGUMENT,
                            "%s shape %d is not opaque: tracers light opaque shapes only",
                            layer == DPL_TRACER_STATIC ? "static" : "dynamic", tracer->not_opaque[layer]);
    return DPL_OK;
}

dpl_status dpl_tracer_light(dpl_tracer *tracer, const dpl_tracer_light_desc *desc, const dpl_output *given) {
    if (!tracer || !desc || !given)
        return DPL_ERROR_ARGUMENT;
    dpl_output output = *given;
    DPL_TRY(check_light(tracer, desc));
    DPL_TRY(check_output(tracer, &output));
    return dpl_tracer_light_picture(tracer, desc, &output);
}

/* ---- counters ------------------------------------------------------------------------------------- */

void dpl_tracer_read_stats(const dpl_tracer *tracer, dpl_tracer_stats *stats) {
    const dpl_tracer_counts *counts = &tracer->counts;
    *stats = (dpl_tracer_stats){
        .rays = counts->rays,
        .object_tests = counts->walks.object_tests,
        .node_visits = counts->walks.node_visits,
        .static_rays = counts->static_rays,
        .kept_bytes = (int64_t)tracer->kept.bytes,
    };
    for (int layer = 0; layer < DPL_TRACER_LAYERS; layer++) {
        const dpl_bvh *bvh = dpl_tracer_bvh(tracer, layer);
        stats->objects[layer] = tracer->shapes[layer].count + tracer->triangles[layer].count;
        stats->builds[layer] = bvh->builds;
        stats->refits[layer] = bvh->refits;
        stats->depth[layer] = bvh->depth;
        stats->hierarchy_bytes += (int64_t)bvh->node_count * (int64_t)sizeof(dpl_bvh_node);
    }
}

void dpl_tracer_reset_stats(dpl_tracer *tracer) {
    tracer->counts = (dpl_tracer_counts){0};
    for (int layer = 0; layer < DPL_TRACER_LAYERS; layer++) {
        tracer->shapes[layer].bvh.builds = tracer->shapes[layer].bvh.refits = 0;
        tracer->triangles[layer].bvh.builds = tracer->triangles[layer].bvh.refits = 0;
    }
}
