/* The tracer: two layers of objects and what is counted. Rays are traced in tracer.c, pictures lit in
 * light.c; arguments are checked in src/api/tracer.c. */
#ifndef DPL_TRACER_TRACER_H
#define DPL_TRACER_TRACER_H

#include "bvh/shape.h"
#include "bvh/triangle.h"

#include <dapple/tracer.h>

#define DPL_TRACER_LAYERS 2

/* What a ray hit of the static layer, as kept from picture to picture. */
typedef struct dpl_kept_hit {
    float t;
    int32_t object;
} dpl_kept_hit;

/* Of which picture static hits are kept; valid only for the same numbers. */
typedef struct dpl_kept_picture {
    int32_t width; /* 0: nothing is kept */
    int32_t height;
    int32_t directions;
} dpl_kept_picture;

typedef struct dpl_tracer_counts {
    dpl_walk_counts walks;
    int64_t rays;
    int64_t static_rays;
} dpl_tracer_counts;

struct dpl_tracer {
    dpl_context *context;
    dpl_tracer_desc desc;
    /* By layer. Only those of the geometry in the desc are in use. */
    dpl_shapes shapes[DPL_TRACER_LAYERS];
    dpl_triangles triangles[DPL_TRACER_LAYERS];
    dpl_buffer emission[DPL_TRACER_LAYERS]; /* float[3] per shape */
    int32_t not_opaque[DPL_TRACER_LAYERS];  /* first shape that lets light through; -1: none */
    dpl_tracer_counts counts;
    dpl_buffer directions; /* float[2] per direction of light.c */
    int32_t direction_count;
    dpl_buffer kept; /* dpl_kept_hit per pixel and direction */
    dpl_kept_picture kept_picture;
};

static inline const dpl_bvh *dpl_tracer_bvh(const dpl_tracer *tracer, int layer) {
    return tracer->desc.geometry == DPL_TRACER_SHAPES ? &tracer->shapes[layer].bvh
                                                      : &tracer->triangles[layer].bvh;
}

/* Replaces checked shapes or triangles of a layer. */
DPL_MUST_CHECK dpl_status dpl_tracer_keep_shapes(dpl_tracer *tracer, dpl_tracer_layer layer,
                                                 const dpl_shape *shapes, int32_t count);
DPL_MUST_CHECK dpl_status dpl_tracer_keep_triangles(dpl_tracer *tracer, dpl_tracer_layer layer,
                                                    const dpl_triangles_source *source);

/* One of `hits` and `occluded` is NULL. */
DPL_MUST_CHECK dpl_status dpl_tracer_trace_batch(dpl_tracer *tracer, const dpl_ray *rays, int64_t count,
                                                 dpl_hit *hits, uint8_t *occluded);

/* light.c: the output has an explicit stride, the shapes are opaque. */
DPL_MUST_CHECK dpl_status dpl_tracer_light_picture(dpl_tracer *tracer, const dpl_tracer_light_desc *desc,
                                                   const dpl_output *output);

/* Counters of workers, each on cache lines of its own, and their sum added to the tracer's. */
typedef struct dpl_tracer_worker {
    dpl_tracer_counts counts;
    char padding[128 - sizeof(dpl_tracer_counts)];
} dpl_tracer_worker;

void dpl_tracer_add_counts(dpl_tracer *tracer, const dpl_tracer_worker workers[DPL_MAX_THREADS]);

#endif
