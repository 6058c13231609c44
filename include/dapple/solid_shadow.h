/** @file
 * Shadows in space: how much of a light with a size each of the caller's points sees past a mesh.
 *
 * The visibility V of a light at a receiver is the share of the light's disc that no triangle covers: 1 is
 * lit, 0 is dark. The disc is what the receiver sees of a ball: it stands across the line to the light's
 * middle and has the light's radius. Parts of it below the receiver's horizon count as covered. A receiver
 * outside the cone of a spot light has V = 0. Lights block nothing.
 *
 * M.R.M.A. looks at receivers through a map seen from the light. What that does not settle is given to a few
 * rays at once; or, where none are allowed, to the map's moments and to a march through the signed distance
 * to the mesh, of which it takes the tighter answer.
 */
#ifndef DAPPLE_SOLID_SHADOW_H
#define DAPPLE_SOLID_SHADOW_H

#include <dapple/context.h>
#include <dapple/export.h>
#include <dapple/mesh.h>
#include <dapple/status.h>
#include <math.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/** What a light in space is. */
typedef enum dpl_solid_light_kind {
    DPL_SOLID_LIGHT_SPOT = 0,   /**< shines from a point into a cone */
    DPL_SOLID_LIGHT_POINT,      /**< shines from a point everywhere */
    DPL_SOLID_LIGHT_DIRECTIONAL /**< infinitely far away: a sun */
} dpl_solid_light_kind;

/** A light. Start from dpl_solid_light_default(). */
typedef struct dpl_solid_light {
    uint32_t struct_size;      /**< stamped by the default function */
    uint32_t cookie;           /**< stamped by the default function */
    dpl_solid_light_kind kind; /**< default DPL_SOLID_LIGHT_SPOT */
    float position[3];         /**< of spot and point lights [scene unit], within 1e6, default (0, 0, 0) */
    float direction[3]; /**< in which spot and directional lights shine, any length, default (0, 0, -1) */
    float radius;       /**< of spot and point lights [scene unit], of directional ones half the angle
                             that they cover [rad], at most 1; > 0, default 0.1 */
    float angle;        /**< from a spot light's axis to the edge of its cone [rad], 0.01 .. 1.4,
                             default 0.7 */
    float color[3];     /**< RGB, linear, >= 0, default 1 */
    float intensity;    /**< spot, point: irradiance at distance 1; directional: anywhere; across the
                             light; >= 0, default 1 */
} dpl_solid_light;

/** Defaults of a light: a white spot light that looks down from the origin. */
static inline dpl_solid_light dpl_solid_light_default(void) {
    dpl_solid_light light;
    memset(&light, 0, sizeof light);
    light.struct_size = (uint32_t)sizeof light;
    light.cookie = DPL_DESC_COOKIE;
    light.direction[2] = -1.0f;
    light.radius = 0.1f;
    light.angle = 0.7f;
    light.color[0] = light.color[1] = light.color[2] = 1.0f;
    light.intensity = 1.0f;
    return light;
}

/**
 * The irradiance that a light would give a receiver if nothing were in between: color * intensity, over the
 * squared distance except for directional lights, times the cosine between the normal and the way to the
 * light's middle; nothing outside a spot light's cone.
 * @param light    as dpl_solid_shadow_set_light() takes it
 * @param position [scene unit]
 * @param normal   of length 1
 * @param rgb      receives the irradiance
 * Thread-safe.
 */
DPL_API void dpl_solid_light_shine(const dpl_solid_light *light, const float position[3],
                                   const float normal[3], float rgb[3]);

/** How visibility is found. */
typedef enum dpl_solid_method {
    DPL_SOLID_MRMA = 0, /**< by the light's map, and rays, or moments and march blended, where that is open */
    DPL_SOLID_MOMENTS,  /**< the moment map alone: four moments, soft (Peters et al. 2017) */
    DPL_SOLID_MARCH,    /**< the march alone, with `sub_cones` */
    DPL_SOLID_REFERENCE /**< brute force: `samples` rays to points spread evenly over the disc. Slow */
} dpl_solid_method;

/** Number of methods: they count from 0. */
#define DPL_SOLID_METHOD_COUNT 4

/** The weight a of the map in V = a V_map + (1 - a) V_march. */
typedef enum dpl_solid_weight {
    DPL_SOLID_WEIGHT_SMOOTH_MIN = 0, /**< a = 1 / (1 + exp(-(V_march - V_map) / tau)) */
    DPL_SOLID_WEIGHT_MIN,            /**< a = 1 where V_map < V_march, else 0 */
    DPL_SOLID_WEIGHT_CONSTANT        /**< a = `constant` */
} dpl_solid_weight;

/** Number of weights: they count from 0. */
#define DPL_SOLID_WEIGHT_COUNT 3

/** How to make a shadow. Start from dpl_solid_shadow_desc_default(). */
typedef struct dpl_solid_shadow_desc {
    uint32_t struct_size;    /**< stamped by the default function */
    uint32_t cookie;         /**< stamped by the default function */
    dpl_solid_method method; /**< default DPL_SOLID_MRMA */
    dpl_solid_weight weight; /**< of DPL_SOLID_MRMA, default DPL_SOLID_WEIGHT_SMOOTH_MIN */
    float tau;               /**< of the smooth minimum, 0 < tau <= 1, default 0.03 */
    float constant;          /**< 0 .. 1, default 0.5 */
    int32_t map_resolution;  /**< texels along a side of a map, a multiple of 4, 16 .. 4096, default 512.
                                  A point light has six maps */
    int32_t sub_cones;       /**< of the march: parts of the disc, 1, 4, 9 or 16, default 1 */
    int32_t samples;         /**< rays of the reference, 1 .. 65536, default 256 */
    int32_t refine_rays;    /**< of DPL_SOLID_MRMA: rays of refinement, 0 .. 256; 0: none are asked. Multiples
                                 of 16 cost no more than what is just above the one before. Default 32 */
    float refine_threshold; /**< 0 (default): every receiver that classification leaves open is refined; else
                                 where map and march differ by more than this, and in contact; 0 .. 1 */
    float refine_distance;  /**< receivers farther than this from `eye` are not refined, > 0 [scene unit],
                                 default INFINITY */
    float eye[3];           /**< of the camera [scene unit] */
    int32_t classify;       /**< 1 (default): receivers that a look at the nearest and farthest depths proves
                                 lit or dark are not worked on; 0: all are. The reference works on all */
} dpl_solid_shadow_desc;

/** Defaults of a shadow: M.R.M.A. with 512 x 512 texels, one cone, 32 rays where its map leaves V open. */
static inline dpl_solid_shadow_desc dpl_solid_shadow_desc_default(void) {
    dpl_solid_shadow_desc desc;
    memset(&desc, 0, sizeof desc);
    desc.struct_size = (uint32_t)sizeof desc;
    desc.cookie = DPL_DESC_COOKIE;
    desc.tau = 0.03f;
    desc.constant = 0.5f;
    desc.map_resolution = 512;
    desc.sub_cones = 1;
    desc.samples = 256;
    desc.refine_rays = 32;
    desc.refine_distance = INFINITY;
    desc.classify = 1;
    return desc;
}

/** What a shadow has done since its light was set. Counted, not computed. */
typedef struct dpl_solid_shadow_stats {
    int64_t receivers;    /**< asked for */
    int64_t lit;          /**< of them, found lit by classification */
    int64_t dark;         /**< found dark by classification, turned away or outside the cone */
    int64_t refined;      /**< given to rays of refinement */
    int64_t steps;        /**< of marches */
    int64_t rays;         /**< of the reference and of refinement */
    int64_t memory_bytes; /**< that the shadow holds [byte] */
} dpl_solid_shadow_stats;

/** Opaque. Uses the context it was made from; one thread at a time. */
typedef struct dpl_solid_shadow dpl_solid_shadow;

/**
 * Makes a shadow without a light.
 * @param context the context, must outlive the shadow
 * @param desc    from dpl_solid_shadow_desc_default()
 * @param shadow  receives the shadow, or NULL on failure
 * @return DPL_OK; DPL_ERROR_DESC, _ARGUMENT naming what is out of range, _MEMORY
 */
DPL_API DPL_MUST_CHECK dpl_status dpl_solid_shadow_create(dpl_context *context,
                                                          const dpl_solid_shadow_desc *desc,
                                                          dpl_solid_shadow **shadow);

/** Frees a shadow. NULL is fine. */
DPL_API void dpl_solid_shadow_destroy(dpl_solid_shadow *shadow);

/**
 * Sets what casts and what shines: builds the light's map, in parallel. Both mesh and field are kept by
 * reference and must stay as they are until the next call. Allocates only for a kind of light that has more
 * maps than any before. On failure the shadow is without a light.
 * @param mesh  what casts
 * @param field distances to that mesh; may be NULL unless the method marches
 * @param light from dpl_solid_light_default()
 * @return DPL_OK; DPL_ERROR_DESC; _ARGUMENT naming what is wrong, also for a mesh without triangles and a
 * field that has not been measured; _MEMORY
 * Source: docs/algorithms/solid-shadows.md
 */
DPL_API DPL_MUST_CHECK dpl_status dpl_solid_shadow_set_light(dpl_solid_shadow *shadow, const dpl_mesh *mesh,
                                                             const dpl_mesh_field *field,
                                                             const dpl_solid_light *light);

/**
 * Finds the visibility of the light for each receiver, in parallel. The same bytes for every number of
 * threads. Never allocates.
 * @param positions  shape [count][3] [scene unit]; one that is not finite has V = 0
 * @param normals    shape [count][3], of length 1, on the side that is looked at; may be NULL: receivers
 *                   that face every light and lie on no surface
 * @param count      >= 0
 * @param visibility receives `count` values 0 .. 1
 * @return DPL_OK; DPL_ERROR_ARGUMENT, also before a light was set
 */
DPL_API DPL_MUST_CHECK dpl_status dpl_solid_shadow_visibility(dpl_solid_shadow *shadow,
                                                              const float (*positions)[3],
                                                              const float (*normals)[3], int64_t count,
                                                              float *visibility);

/** Counters since the light was set. */
DPL_API void dpl_solid_shadow_read_stats(const dpl_solid_shadow *shadow, dpl_solid_shadow_stats *stats);

/** Name of a method as the command line spells it: "mrma", "moments", "march", "reference", or "?".
 * Thread-safe. */
DPL_API const char *dpl_solid_method_name(dpl_solid_method method);

/** A pinhole camera. Start from dpl_solid_camera_default(). */
typedef struct dpl_solid_camera {
    uint32_t struct_size; /**< stamped by the default function */
    uint32_t cookie;      /**< stamped by the default function */
    float eye[3];         /**< [scene unit], default (0, 0, 0) */
    float target[3];      /**< what is in the middle of the picture [scene unit], default (0, 0, -1) */
    float up[3];          /**< what is up in it, default (0, 1, 0) */
    float angle;          /**< from the bottom to the top of the picture [rad], 0.001 .. 3, default 0.8 */
    int32_t width;        /**< [px], 1 .. 16384, default 640 */
    int32_t height;       /**< [px], 1 .. 16384, default 480 */
} dpl_solid_camera;

/** Defaults of a camera: at the origin, looking along -z, 640 x 480. */
static inline dpl_solid_camera dpl_solid_camera_default(void) {
    dpl_solid_camera camera;
    memset(&camera, 0, sizeof camera);
    camera.struct_size = (uint32_t)sizeof camera;
    camera.cookie = DPL_DESC_COOKIE;
    camera.target[2] = -1.0f;
    camera.up[1] = 1.0f;
    camera.angle = 0.8f;
    camera.width = 640;
    camera.height = 480;
    return camera;
}

/**
 * What a camera sees of a mesh: through the middle of each pixel the nearest point, rows top to bottom, in
 * parallel. The points are receivers for dpl_solid_shadow_visibility(). Never allocates.
 * @param mesh      what is looked at
 * @param camera    from dpl_solid_camera_default()
 * @param positions receives [height][width][3] [scene unit]; not-a-number where nothing is seen
 * @param normals   receives [height][width][3]: of the triangle, length 1, turned towards the camera; zeros
 *                  where nothing is seen
 * @param triangles receives [height][width]: number of the triangle, -1 where nothing is seen
 * @return DPL_OK; DPL_ERROR_DESC, _SIZE, _ARGUMENT naming what is wrong
 */
DPL_API DPL_MUST_CHECK dpl_status dpl_solid_camera_look(const dpl_mesh *mesh, const dpl_solid_camera *camera,
                                                        float (*positions)[3], float (*normals)[3],
                                                        int32_t *triangles);

#ifdef __cplusplus
}
#endif
#endif
