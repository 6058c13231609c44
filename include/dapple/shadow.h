/** @file
 * Shadows of lights with a size: how much of a disc of light each pixel sees, by many methods.
 *
 * The visibility V of a light at a pixel's centre is the share of the light's angular extent, seen from
 * there, that no opaque pixel covers before the disc: 1 is lit, 0 is dark. Pixels inside the disc have V = 1,
 * opaque pixels V = 0. A light blocks nothing, itself included. A light of radius 0 has a hard shadow and,
 * covering no angle, gives no radiance.
 *
 * Lights may stand anywhere: in the open, outside the picture, touching a wall, inside one (only what lies
 * between the disc's rim and the receiver blocks).
 */
#ifndef DAPPLE_SHADOW_H
#define DAPPLE_SHADOW_H

#include <dapple/context.h>
#include <dapple/export.h>
#include <dapple/field.h>
#include <dapple/image.h>
#include <dapple/light.h>
#include <dapple/solver.h>
#include <dapple/status.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/** How visibility is found. Costs and errors of all: docs/algorithms/mrma.md. */
typedef enum dpl_shadow_method {
    /** Union of the angles that opaque pixels cover: exact but for rounding. */
    DPL_SHADOW_EXACT = 0,
    /** Brute force: `samples` rays, evenly spread over the light's angle, exact traversal. Slow. */
    DPL_SHADOW_REFERENCE,
    /** Variance shadow map (Donnelly and Lauritzen 2006) in one dimension, one kernel for all depths. */
    DPL_SHADOW_MOMENTS_2,
    /** Exponential variance shadow map (Lauritzen and McCool 2008), the same kernel. */
    DPL_SHADOW_MOMENTS_EXPONENTIAL,
    /** Moment shadow map of four moments (Peters and Klein 2015), the same kernel. */
    DPL_SHADOW_MOMENTS_4,
    /** Four moments with a blocker search, the kernel as wide as the penumbra (Peters et al. 2017). */
    DPL_SHADOW_MOMENTS_SOFT,
    /** Percentage closer soft shadows (Fernando 2005): the baseline. */
    DPL_SHADOW_PCSS,
    /** Sphere tracing to the light's centre: lit or not. */
    DPL_SHADOW_DISTANCE_HARD,
    /** The narrowest of the gaps that the ray passes (Quilez 2010): outer half of the penumbra only. */
    DPL_SHADOW_DISTANCE_QUILEZ,
    /** The same with Aaltonen's estimate of where the gap is narrowest (2018). */
    DPL_SHADOW_DISTANCE_AALTONEN,
    /** Marches on into walls by the signed distance, and covers the light's angle exactly by a straight edge.
     */
    DPL_SHADOW_DISTANCE_SIGNED,
    /** The same with the gaps to the left and to the right of the ray told apart. */
    DPL_SHADOW_DISTANCE_TWO_SIDED,
    /** The mean of `sub_cones` signed marches, each to its share of the light. */
    DPL_SHADOW_DISTANCE_CONES,
    /** M.R.M.A.: a map term and a field term, blended by `weight`. */
    DPL_SHADOW_MRMA,
    /** Shadow maps from 56 (`samples`, at most 256) places across the disc: what `exact` gives, rounded to
     * that many steps, and a little faster. */
    DPL_SHADOW_RAYS
} dpl_shadow_method;

/** Number of methods: they count from 0. */
#define DPL_SHADOW_METHOD_COUNT 15

/** The weight a of the map term in V = a V_map + (1 - a) V_field. */
typedef enum dpl_shadow_weight {
    DPL_WEIGHT_SMOOTH_MIN = 0, /**< a = 1 / (1 + exp(-(V_field - V_map) / tau)) */
    DPL_WEIGHT_MIN,            /**< a = 1 where V_map < V_field, else 0 */
    DPL_WEIGHT_CONSTANT,       /**< a = `constant` */
    DPL_WEIGHT_DISTANCE,       /**< a = d / (d + k), d from receiver to light, k = `blend_distance` */
    DPL_WEIGHT_GAP,            /**< a = g / (g + k), g from receiver to the blocker that the march met */
    DPL_WEIGHT_VARIANCE,       /**< by the inverse of the two terms' estimated variances */
    DPL_WEIGHT_LITERAL         /**< the paper's equations as printed, clamped to 0 .. 1: for study */
} dpl_shadow_weight;

/** Number of weights: they count from 0. */
#define DPL_WEIGHT_COUNT 7

/** How to make a shadow. Start from dpl_shadow_desc_default(). */
typedef struct dpl_shadow_desc {
    uint32_t struct_size;     /**< stamped by the default function */
    uint32_t cookie;          /**< stamped by the default function */
    dpl_shadow_method method; /**< default DPL_SHADOW_EXACT */
    dpl_shadow_weight weight; /**< of DPL_SHADOW_MRMA, default DPL_WEIGHT_SMOOTH_MIN */
    dpl_shadow_method
        map_method; /**< its map term: DPL_SHADOW_RAYS (default; 32 of them), _MOMENTS_SOFT or _PCSS */
    dpl_shadow_method field_method; /**< its field term, one of DPL_SHADOW_DISTANCE_*, default _CONES */
    float tau;                      /**< of the smooth minimum, 0 < tau <= 1, default 0.03 */
    float constant;                 /**< 0 .. 1, default 0.5 */
    float blend_distance;           /**< > 0 [px], default 32 */
    int32_t map_resolution;         /**< texels around a light, a multiple of 4, 16 .. 65536, default 2048 */
    int32_t field_level;            /**< the march reads distances every 2^level pixels, 0 .. 4, default 0 */
    int32_t sub_cones;              /**< of DPL_SHADOW_DISTANCE_CONES, 1 .. 64, default 4 */
    int32_t samples;  /**< rays of the reference, taps of PCSS, 1 .. 65536; places of the rays, 1 .. 256, made
                         even;  0 (default): 256, 32, 56 */
    int32_t guard;    /**< 1 (default): MRMA leaves a term out where its map or field is coarser than the
                           penumbra, and a minimum leaves a term out where the other is known to err less
                           than half as much: with the defaults the field serves only where the ray map
                           cannot, near the light */
    int32_t classify; /**< 1 (default): pixels that one look at the horizon around the light proves lit or
                         dark are not worked on; 0: all are. The reference works on all */
    dpl_progress_function progress; /**< may be NULL; called on the thread that called */
    void *progress_user;            /**< handed to `progress` */
} dpl_shadow_desc;

/** Defaults of a shadow: exact. */
static inline dpl_shadow_desc dpl_shadow_desc_default(void) {
    dpl_shadow_desc desc;
    memset(&desc, 0, sizeof desc);
    desc.struct_size = (uint32_t)sizeof desc;
    desc.cookie = DPL_DESC_COOKIE;
    desc.method = DPL_SHADOW_EXACT;
    desc.weight = DPL_WEIGHT_SMOOTH_MIN;
    desc.map_method = DPL_SHADOW_RAYS;
    desc.field_method = DPL_SHADOW_DISTANCE_CONES;
    desc.tau = 0.03f;
    desc.constant = 0.5f;
    desc.blend_distance = 32.0f;
    desc.map_resolution = 2048;
    desc.sub_cones = 4;
    desc.guard = 1;
    desc.classify = 1;
    return desc;
}

/** What the last success did, summed over its lights. Counted, not computed. */
typedef struct dpl_shadow_stats {
    int32_t lights;       /**< 1 for dpl_shadow_visibility() */
    int64_t pixels;       /**< receivers: pixels times lights, opaque ones left out */
    int64_t lit;          /**< of them, found lit by the horizon or inside the disc */
    int64_t dark;         /**< found dark by the horizon */
    int64_t worked;       /**< the rest: a method worked on them */
    int64_t steps;        /**< steps of marches, columns of pixels looked at, cells of rays */
    int64_t fetches;      /**< reads of the world or the map by the methods */
    int64_t map_only;     /**< pixels where the guard fell back to the map term */
    int64_t field_only;   /**< pixels where the guard fell back to the field term */
    double field_ms;      /**< wall time of bits and distances, 0 when the field had not changed [ms] */
    double map_ms;        /**< wall time of horizons and maps [ms] */
    double solve_ms;      /**< wall time of the rest [ms] */
    int64_t memory_bytes; /**< that the shadow holds [byte] */
} dpl_shadow_stats;

/** Opaque. Uses the context it was made from; one thread at a time. */
typedef struct dpl_shadow dpl_shadow;

/**
 * Makes a shadow. Buffers are allocated by the first use at a size and kept for the next.
 * @param context the context, must outlive the shadow
 * @param desc    from dpl_shadow_desc_default()
 * @param shadow  receives the shadow, or NULL on failure
 * @return DPL_OK; DPL_ERROR_DESC, _ARGUMENT, _MEMORY
 */
DPL_API DPL_MUST_CHECK dpl_status dpl_shadow_create(dpl_context *context, const dpl_shadow_desc *desc,
                                                    dpl_shadow **shadow);

/** Frees a shadow. NULL is fine. */
DPL_API void dpl_shadow_destroy(dpl_shadow *shadow);

/**
 * Visibility of one light. The same field gives the same bytes for every thread count and task system.
 *
 * Only opaque pixels count: media do not, here.
 * @param field      made from the same context
 * @param light      the light; colour and intensity do not matter
 * @param visibility receives V, 0 .. 1, shape [height][width]; written only on success
 * @param row_stride from a row to the next [byte]; 0: tightly packed; may be negative
 * @return DPL_OK; DPL_ERROR_ARGUMENT, _SIZE, _MEMORY, _CANCELLED
 */
DPL_API DPL_MUST_CHECK dpl_status dpl_shadow_visibility(dpl_shadow *shadow, dpl_field *field,
                                                        const dpl_light *light, float *visibility,
                                                        ptrdiff_t row_stride);

/**
 * The light of all lights: mean radiance sum of V color intensity asin(R/d)/pi, inside a disc V color
 * intensity. Opaque pixels get 0. Media take their share: the reference follows each ray through them, other
 * methods multiply by what the ray to the light's centre keeps as far as the disc's rim, as if the whole disc
 * were seen along it.
 * @param lights array of `count` lights
 * @param count  >= 0
 * @param output of the picture's size, DPL_FORMAT_F32 or DPL_FORMAT_F16; written only on success
 * @return DPL_OK; DPL_ERROR_ARGUMENT naming the light, _SIZE, _MEMORY, _CANCELLED
 */
DPL_API DPL_MUST_CHECK dpl_status dpl_shadow_light(dpl_shadow *shadow, dpl_field *field,
                                                   const dpl_light *lights, int32_t count,
                                                   const dpl_output *output);

/** Counters and times of the last success; zeros before the first. */
DPL_API void dpl_shadow_read_stats(const dpl_shadow *shadow, dpl_shadow_stats *stats);

/** Name of a method as the command line spells it ("exact", "moments-soft", …), or "?". Thread-safe. */
DPL_API const char *dpl_shadow_method_name(dpl_shadow_method method);

/** Name of a weight as the command line spells it ("smooth-min", …), or "?". Thread-safe. */
DPL_API const char *dpl_shadow_weight_name(dpl_shadow_weight weight);

#ifdef __cplusplus
}
#endif
#endif
