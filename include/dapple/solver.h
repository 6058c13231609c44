/** @file
 * Solvers: a field goes in, the mean radiance that arrives at each pixel's centre comes out.
 *
 * Mean radiance is fluence / 2pi: the average over all directions of the linear RGB radiance that arrives.
 * Inside an opaque pixel it is that pixel's emission.
 *
 * With bounces, walls reflect. An opaque pixel has four faces; a face is exposed where the pixel before it is
 * in the world and not opaque. It receives what arrives at that pixel's centre from the half plane it looks
 * at, the irradiance E = int L(theta) cos(theta) dtheta, and sends out albedo * E / 2 in all directions alike
 * (Lambert's law in two dimensions). A ray that enters an opaque pixel by a face sees its emission and what
 * that face sends out. N bounces are N rounds of this, from no reflection at all. An opaque pixel then shows
 * its emission and the mean over its exposed faces. Media do not scatter: their albedo is ignored.
 *
 * Lights (dpl_light) are not in the field and solvers do not see them, but with bounces walls reflect those
 * that dpl_solver_set_lights() names: a face receives E of them, too.
 */
#ifndef DAPPLE_SOLVER_H
#define DAPPLE_SOLVER_H

#include <dapple/context.h>
#include <dapple/export.h>
#include <dapple/field.h>
#include <dapple/image.h>
#include <dapple/light.h>
#include <dapple/schedule.h>
#include <dapple/status.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/** Which method. */
typedef enum dpl_solver_kind {
    DPL_SOLVER_CASCADES = 0,   /**< radiance cascades: interactive, close to the truth */
    DPL_SOLVER_REFERENCE = 1,  /**< brute force, exact grid traversal: slow, the truth */
    DPL_SOLVER_HOLOGRAPHIC = 2 /**< holographic radiance cascades: interactive, hard to tell from the truth */
} dpl_solver_kind;

/** Most bounces of a solver. */
#define DPL_MAX_BOUNCES 8

/** How a solver keeps what it works on. */
typedef enum dpl_storage {
    DPL_STORAGE_FLOAT = 0, /**< 32 bits: the reference */
    DPL_STORAGE_HALF = 1 /**< 16 bits, arithmetic in floats: half the memory, and faster where memory is slow;
                            light up to 65504; extinction is off by up to 0.0005 per pixel, so that fog
                            thinner than that may be lost */
} dpl_storage;

/** How finely light is solved, whatever the size of the picture. */
typedef enum dpl_resolution {
    DPL_RESOLUTION_FULL = 0,    /**< a probe per pixel */
    DPL_RESOLUTION_HALF = 1,    /**< a probe per 2 x 2 pixels: about a third of the time */
    DPL_RESOLUTION_QUARTER = 2, /**< a probe per 4 x 4 pixels: about a seventh of the time */
    DPL_RESOLUTION_DOUBLE = 3   /**< four probes per pixel: about half the error, five times the time */
} dpl_resolution;

/** Settings of DPL_SOLVER_HOLOGRAPHIC. */
typedef struct dpl_holographic_desc {
    dpl_storage storage;       /**< default DPL_STORAGE_FLOAT */
    dpl_resolution resolution; /**< default DPL_RESOLUTION_FULL */
} dpl_holographic_desc;

/** Settings of DPL_SOLVER_REFERENCE. */
typedef struct dpl_reference_desc {
    int32_t directions; /**< per pixel, uniformly spaced, 1 .. 1048576, default 4096 */
} dpl_reference_desc;

/**
 * Told now and then how far a long solve has come.
 * @param done 0 .. 1
 * @return non-zero to go on, 0 to cancel
 */
typedef int (*dpl_progress_function)(double done, void *user);

/** How to make a solver. Start from dpl_solver_desc_default(). */
typedef struct dpl_solver_desc {
    uint32_t struct_size;             /**< stamped by the default function */
    uint32_t cookie;                  /**< stamped by the default function */
    dpl_solver_kind kind;             /**< default DPL_SOLVER_HOLOGRAPHIC */
    dpl_cascades_desc cascades;       /**< read by DPL_SOLVER_CASCADES */
    dpl_reference_desc reference;     /**< read by DPL_SOLVER_REFERENCE */
    dpl_holographic_desc holographic; /**< read by DPL_SOLVER_HOLOGRAPHIC */
    int32_t bounces; /**< how often light is reflected by walls, 0 .. DPL_MAX_BOUNCES, default 0;
                        DPL_SOLVER_CASCADES takes 0 only */
    int32_t reuse; /**< 1: keep the last frame, and solve only what has changed since; where nothing has, its
                      picture is handed out again and no ray traced. The result is the same to the last bit.
                      Costs memory: at the defaults 85 (DPL_SOLVER_CASCADES), 170 (DPL_SOLVER_HOLOGRAPHIC) or
                      29 (DPL_SOLVER_REFERENCE) bytes per pixel. Which settings solve a changed frame in full
                      says docs/algorithms/reuse.md. Default 0 */
    dpl_progress_function progress; /**< may be NULL; called on the thread that called dpl_solver_solve() */
    void *progress_user;            /**< handed to `progress` */
} dpl_solver_desc;

/** Defaults of a solver: holographic radiance cascades in floats, a probe per pixel. Cascades, when asked
 * for, are bilinear-fix with a probe per pixel. */
static inline dpl_solver_desc dpl_solver_desc_default(void) {
    dpl_solver_desc desc;
    memset(&desc, 0, sizeof desc);
    desc.struct_size = (uint32_t)sizeof desc;
    desc.cookie = DPL_DESC_COOKIE;
    desc.kind = DPL_SOLVER_HOLOGRAPHIC;
    desc.cascades.merge = DPL_MERGE_BILINEAR_FIX;
    return desc;
}

/** Counters of one level of a solve. The reference has one level, of pixels; with bounces a second, of the
 * faces of walls: each counts once per bounce and looks at half of the directions; and with lights a third,
 * of the same faces once for each light, with the rays that look at it. */
typedef struct dpl_level_stats {
    int64_t probes;     /**< points that rays start from */
    int32_t directions; /**< per probe */
    int64_t full;       /**< rays if nothing is skipped */
    int64_t traced;     /**< rays counted where they were traced */
} dpl_level_stats;

/** What the last solve did. */
typedef struct dpl_solver_stats {
    int32_t level_count;                    /**< entries of `levels` in use */
    dpl_level_stats levels[DPL_MAX_LEVELS]; /**< level 0 first */
    int64_t rays_full;                      /**< sum over levels */
    int64_t rays_traced;                    /**< sum over levels */
    dpl_skip_report skip;                   /**< what ray skipping did */
    double field_ms;                        /**< wall time spent on the distance field [ms] */
    double solve_ms;                        /**< wall time of the rest [ms] */
    int64_t memory_bytes;                   /**< that the solver holds [byte] */
} dpl_solver_stats;

/** Opaque. Uses the context it was made from; one thread at a time. */
typedef struct dpl_solver dpl_solver;

/**
 * Makes a solver. Buffers are allocated by the first solve at a size and kept for the next.
 * @param context the context, must outlive the solver
 * @param desc    from dpl_solver_desc_default()
 * @param solver  receives the solver, or NULL on failure
 * @return DPL_OK; DPL_ERROR_DESC, _ARGUMENT, _MEMORY
 */
DPL_API DPL_MUST_CHECK dpl_status dpl_solver_create(dpl_context *context, const dpl_solver_desc *desc,
                                                    dpl_solver **solver);

/** Frees a solver. NULL is fine. */
DPL_API void dpl_solver_destroy(dpl_solver *solver);

/**
 * Names the lights that walls reflect, for all solves to come; none at first. What a solve returns then holds
 * the light that comes by way of walls, and not what lights give directly: add dpl_shadow_light() of the same
 * lights, and each is there exactly once. Without bounces it changes nothing. A light is seen from a face
 * through the field's opaque pixels and media; DPL_SOLVER_HOLOGRAPHIC takes media along the way to the
 * light's centre. A light of radius 0 covers no angle and gives nothing.
 * @param lights array of `count` lights, copied
 * @param count  >= 0
 * @return DPL_OK; DPL_ERROR_ARGUMENT naming the light, _MEMORY; on failure the lights before stay. A call
 * with no more lights than ever before allocates nothing. Source: the direct term of the rendering equation
 * (Kajiya 1986), in the plane; docs/algorithms/bounces.md.
 */
DPL_API DPL_MUST_CHECK dpl_status dpl_solver_set_lights(dpl_solver *solver, const dpl_light *lights,
                                                        int32_t count);

/**
 * Lights the field. Brings the field's distances up to date first if it has changed.
 * The same field gives the same bytes for every thread count, task system and instruction set.
 * @param field  made from the same context
 * @param output of the field's size; DPL_FORMAT_F32, or DPL_FORMAT_F16 (rounded to nearest, at most 65504);
 *               a fourth channel is set to 1; written only on success
 * @return DPL_OK; DPL_ERROR_ARGUMENT, _SIZE, _MEMORY, _CANCELLED
 */
DPL_API DPL_MUST_CHECK dpl_status dpl_solver_solve(dpl_solver *solver, dpl_field *field,
                                                   const dpl_output *output);

/**
 * Lights the field and tells where the light comes from: the Fourier coefficients of the arriving radiance L
 * up to the first order. With theta the angle from +x towards +y (downwards) under which light is seen at the
 * pixel,
 *
 *     mean   = 1/2pi int L dtheta
 *     cosine = 1/2pi int L cos(theta) dtheta
 *     sine   = 1/2pi int L sin(theta) dtheta
 *
 * (cosine, sine) points to where the light comes from. To this order a surface that faces the angle n
 * receives the irradiance 2 mean + pi (cosine cos(n) + sine sin(n)). Cosine and sine may be negative; inside
 * opaque pixels they are 0. For DPL_SOLVER_REFERENCE, and DPL_SOLVER_HOLOGRAPHIC at any resolution.
 * @param field  made from the same context
 * @param mean   of the field's size, the same as from dpl_solver_solve()
 * @param cosine of the field's size
 * @param sine   of the field's size; all three are written only on success
 * @return DPL_OK; DPL_ERROR_ARGUMENT (also for a solver that cannot tell), _SIZE, _MEMORY, _CANCELLED
 */
DPL_API DPL_MUST_CHECK dpl_status dpl_solver_solve_directional(dpl_solver *solver, dpl_field *field,
                                                               const dpl_output *mean,
                                                               const dpl_output *cosine,
                                                               const dpl_output *sine);

/**
 * The truth at chosen pixels only. For DPL_SOLVER_REFERENCE.
 * @param pixels shape [count][2]: x, y of each, inside the field
 * @param count  >= 0
 * @param rgb    receives shape [count][3]
 * @return DPL_OK; DPL_ERROR_ARGUMENT (also for another kind of solver), _CANCELLED, _MEMORY
 */
DPL_API DPL_MUST_CHECK dpl_status dpl_reference_solve_pixels(dpl_solver *solver, dpl_field *field,
                                                             const int32_t (*pixels)[2], int32_t count,
                                                             float (*rgb)[3]);

/** Counters and times of the last successful solve; zeros before the first. */
DPL_API void dpl_solver_read_stats(const dpl_solver *solver, dpl_solver_stats *stats);

/** Name of a solver as the command line spells it: "holographic", "cascades", "reference", or "?".
 * Thread-safe. */
DPL_API const char *dpl_solver_kind_name(dpl_solver_kind kind);

#ifdef __cplusplus
}
#endif
#endif
