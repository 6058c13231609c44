/** @file
 * Tracers: rays against geometry itself, shapes of the plane or triangles in space, one object after another
 * or through a hierarchy of boxes. Both ways give the same answers bit for bit.
 *
 * A tracer holds two layers of objects: static ones, which are set once, and dynamic ones, which are set anew
 * for every frame. Each layer has its own hierarchy, so a frame sorts only what moves.
 */
#ifndef DAPPLE_TRACER_H
#define DAPPLE_TRACER_H

#include <dapple/context.h>
#include <dapple/export.h>
#include <dapple/image.h>
#include <dapple/ray.h>
#include <dapple/shape.h>
#include <dapple/status.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/** Most objects in one layer. */
#define DPL_MAX_TRACED_OBJECTS (1 << 27)

/** What a tracer traces. */
typedef enum dpl_tracer_geometry {
    DPL_TRACER_SHAPES = 0,   /**< shapes of the plane, with materials */
    DPL_TRACER_TRIANGLES = 1 /**< triangles in space */
} dpl_tracer_geometry;

/** How a tracer finds what a ray hits. */
typedef enum dpl_tracer_method {
    DPL_TRACER_BVH = 0,  /**< through a hierarchy of boxes: work grows with the logarithm of the objects */
    DPL_TRACER_NAIVE = 1 /**< every object for every ray: best for a few objects, and the yardstick */
} dpl_tracer_method;

/** Which objects. */
typedef enum dpl_tracer_layer {
    DPL_TRACER_STATIC = 0, /**< set once; they come first in the numbers of objects */
    DPL_TRACER_DYNAMIC = 1 /**< set anew for every frame; numbered on from the static ones */
} dpl_tracer_layer;

/** How to make a tracer. Start from dpl_tracer_desc_default(). */
typedef struct dpl_tracer_desc {
    uint32_t struct_size;         /**< stamped by the default function */
    uint32_t cookie;              /**< stamped by the default function */
    dpl_tracer_geometry geometry; /**< default DPL_TRACER_SHAPES */
    dpl_tracer_method method;     /**< default DPL_TRACER_BVH */
} dpl_tracer_desc;

/** Defaults of a tracer: shapes, through a hierarchy. */
static inline dpl_tracer_desc dpl_tracer_desc_default(void) {
    dpl_tracer_desc desc;
    memset(&desc, 0, sizeof desc);
    desc.struct_size = (uint32_t)sizeof desc;
    desc.cookie = DPL_DESC_COOKIE;
    return desc;
}

/** A picture of light to make. Start from dpl_tracer_light_desc_default(). */
typedef struct dpl_tracer_light_desc {
    uint32_t struct_size; /**< stamped by the default function */
    uint32_t cookie;      /**< stamped by the default function */
    int32_t directions;   /**< per pixel, uniformly spaced, 1 .. 1048576, default 64 */
    float sky[3];         /**< RGB radiance of rays that hit nothing, >= 0, default 0 */
    /** 1: what each ray hits of the static layer is kept (8 bytes a ray: width x height x directions), and
     * the following pictures of that size trace dynamic objects only. Default 0: nothing is kept */
    int32_t keep_static;
} dpl_tracer_light_desc;

/** Defaults of a picture: 64 directions, black sky, nothing kept. */
static inline dpl_tracer_light_desc dpl_tracer_light_desc_default(void) {
    dpl_tracer_light_desc desc;
    memset(&desc, 0, sizeof desc);
    desc.struct_size = (uint32_t)sizeof desc;
    desc.cookie = DPL_DESC_COOKIE;
    desc.directions = 64;
    return desc;
}

/** What a tracer has done since it was made or since dpl_tracer_reset_stats(). The same calls count the same,
 * whatever the number of threads. */
typedef struct dpl_tracer_stats {
    int64_t rays;            /**< traced, through one layer or both */
    int64_t object_tests;    /**< shapes or triangles that were asked for a hit */
    int64_t node_visits;     /**< nodes of hierarchies, two boxes each */
    int64_t static_rays;     /**< of `rays`: those that were traced through the static layer */
    int32_t objects[2];      /**< now in each layer, by dpl_tracer_layer */
    int32_t builds[2];       /**< hierarchies built, by layer */
    int32_t refits[2];       /**< hierarchies kept, with their boxes moved, by layer */
    int32_t depth[2];        /**< nodes on the longest way down each hierarchy, by layer */
    int64_t hierarchy_bytes; /**< of the nodes in use in both layers [byte] */
    int64_t kept_bytes;      /**< of the static hits kept by dpl_tracer_light() [byte] */
} dpl_tracer_stats;

/** Opaque. Uses the context it was made from; one thread at a time. */
typedef struct dpl_tracer dpl_tracer;

/**
 * Makes a tracer without objects.
 * @param context the context, must outlive the tracer
 * @param desc    from dpl_tracer_desc_default()
 * @param tracer  receives the tracer, or NULL on failure
 * @return DPL_OK; DPL_ERROR_DESC, _ARGUMENT, _MEMORY
 */
DPL_API DPL_MUST_CHECK dpl_status dpl_tracer_create(dpl_context *context, const dpl_tracer_desc *desc,
                                                    dpl_tracer **tracer);

/** Frees a tracer. NULL is fine. */
DPL_API void dpl_tracer_destroy(dpl_tracer *tracer);

/**
 * Replaces the shapes of a layer by copies of these; later shapes lie over earlier ones, dynamic over static.
 * As many shapes as before keep their hierarchy and only move its boxes, as long as it stays good.
 * Allocates only when a layer holds more than ever before. On failure the layer is empty.
 * @param shapes array of `count`; coordinates within 1e9
 * @param count  0 .. DPL_MAX_TRACED_OBJECTS
 * @return DPL_OK; DPL_ERROR_ARGUMENT naming the shape and what is wrong with it, also for a tracer of
 * triangles; DPL_ERROR_SIZE, _MEMORY
 */
DPL_API DPL_MUST_CHECK dpl_status dpl_tracer_set_shapes(dpl_tracer *tracer, dpl_tracer_layer layer,
                                                        const dpl_shape *shapes, int32_t count);

/**
 * Replaces the triangles of a layer by copies of these, as dpl_tracer_set_shapes() does. Triangles without an
 * area are allowed and never hit.
 * @param vertices     corners, shape [vertex_count][3], finite, within 1e9
 * @param vertex_count >= 0
 * @param indices      numbers of corners, shape [count][3], 0 .. vertex_count-1
 * @param count        0 .. DPL_MAX_TRACED_OBJECTS
 * @return DPL_OK; DPL_ERROR_ARGUMENT naming the corner or triangle, also for a tracer of shapes;
 * DPL_ERROR_SIZE, _MEMORY
 */
DPL_API DPL_MUST_CHECK dpl_status dpl_tracer_set_triangles(dpl_tracer *tracer, dpl_tracer_layer layer,
                                                           const float (*vertices)[3], int32_t vertex_count,
                                                           const int32_t (*indices)[3], int32_t count);

/**
 * Finds the nearest hit of each ray, in parallel. A ray that starts inside a shape hits it where it starts; a
 * triangle is hit from both sides. Of equal t the object with the highest number wins. Answers are the same
 * bit for bit for every method and every number of threads. Never allocates.
 * @param rays  array of `count`
 * @param count >= 0
 * @param hits  receives `count` hits, objects numbered over both layers
 * @return DPL_OK; DPL_ERROR_ARGUMENT
 * Sources: dpl_tracer is described in docs/algorithms/tracing.md. Boxes: Ize 2013, "Robust BVH ray
 * traversal"; triangles: Woop, Benthin, Wald 2013, "Watertight ray/triangle intersection".
 */
DPL_API DPL_MUST_CHECK dpl_status dpl_tracer_trace(dpl_tracer *tracer, const dpl_ray *rays, int64_t count,
                                                   dpl_hit *hits);

/**
 * Says for each ray whether it hits anything: cheaper than where. Never allocates.
 * @param rays     array of `count`
 * @param count    >= 0
 * @param occluded receives 1 or 0 for each
 * @return DPL_OK; DPL_ERROR_ARGUMENT
 */
DPL_API DPL_MUST_CHECK dpl_status dpl_tracer_occluded(dpl_tracer *tracer, const dpl_ray *rays, int64_t count,
                                                      uint8_t *occluded);

/**
 * Lights a picture: mean radiance over uniformly spaced directions from each pixel's centre, where a ray
 * shows the emission of the shape that it enters first, the topmost where several begin, or the sky. All
 * shapes must be opaque. This is the world that dpl_field_draw_shapes() draws, without pixels: the limit of
 * fine pictures.
 *
 * With `keep_static` the first picture traces the static layer and the following ones, of the same size and
 * directions, do not; setting the static layer makes the next picture trace it again. The result is the same
 * bit for bit.
 * @param desc   from dpl_tracer_light_desc_default()
 * @param output any size up to 16384 a side; the picture's top left corner is (0, 0) [px]
 * @return DPL_OK; DPL_ERROR_DESC, _SIZE, _MEMORY; _ARGUMENT also for a tracer of triangles and, naming it,
 * for a shape that is not opaque
 */
DPL_API DPL_MUST_CHECK dpl_status dpl_tracer_light(dpl_tracer *tracer, const dpl_tracer_light_desc *desc,
                                                   const dpl_output *output);

/** Counters since the tracer was made or last reset. */
DPL_API void dpl_tracer_read_stats(const dpl_tracer *tracer, dpl_tracer_stats *stats);

/** Sets the counters of rays, tests, visits, builds and refits to zero. */
DPL_API void dpl_tracer_reset_stats(dpl_tracer *tracer);

/** Name of a method as the command line spells it: "bvh", "naive", or "?". Thread-safe. */
DPL_API const char *dpl_tracer_method_name(dpl_tracer_method method);

#ifdef __cplusplus
}
#endif
#endif
