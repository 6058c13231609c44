/** @file
 * The schedule of radiance cascades: probes, directions and intervals of every level, as plain data.
 *
 * Level n has probes every spacing*2^n pixels, at ((x+.5), (y+.5)) * spacing*2^n, and directions*4^n rays per
 * probe, ray k at angle (k+.5) * 2pi / directions. Its rays cover the interval [t0, t1] with
 * t1 = interval*4^n and t0 = the t1 of the level below. Levels follow until t1 covers the diagonal.
 * Source: Sannikov 2023, "Radiance Cascades"; Osborne and Sannikov 2024, arXiv 2408.14425.
 */
#ifndef DAPPLE_SCHEDULE_H
#define DAPPLE_SCHEDULE_H

#include <dapple/export.h>
#include <dapple/skip.h>
#include <dapple/status.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/** Most levels that a schedule may have. */
#define DPL_MAX_LEVELS 12

/** How many directions of a level share one direction of the level below. */
#define DPL_BRANCHING 4

/** How a ray's interval is joined to the probes of the level above. */
typedef enum dpl_merge {
    /** One ray, then the mean of four parents by distance: cheapest, rings at seams. */
    DPL_MERGE_BILINEAR = 0,
    /** A ray to each of the four parents' own intervals: four times the rays, seamless. */
    DPL_MERGE_BILINEAR_FIX = 1,
    /** A ray to the nearest parent's interval: one ray, 2x2 pixel blocks. */
    DPL_MERGE_NEAREST_FIX = 2
} dpl_merge;

/** Which cascades. */
typedef enum dpl_profile {
    /** The corrected method: exact traversal of the pixel world. */
    DPL_PROFILE_DEFAULT = 0,
    /** The ARC paper's own code, for reproduction: its geometry, its march through a distance field of
     * shapes, its edge blend. Wants a field made with `keep_shape_distance`, and the bilinear merge. */
    DPL_PROFILE_PAPER = 1
} dpl_profile;

/** What a schedule is computed from. Zero means default. */
typedef struct dpl_cascades_desc {
    int32_t spacing;     /**< between probes of level 0 [px], 1 .. 64, default 1; paper 2 */
    int32_t directions;  /**< of a probe of level 0, 4 .. 1024, a multiple of 4, default 4; paper 16 */
    double interval;     /**< length of the interval of level 0 [px], 0.25 .. 1024, default two spacings;
                              paper 4/1023 of the diagonal */
    int32_t levels;      /**< 1 .. DPL_MAX_LEVELS; default: until the diagonal is covered; paper 5 */
    dpl_merge merge;     /**< default DPL_MERGE_BILINEAR, the paper's only one */
    dpl_profile profile; /**< default DPL_PROFILE_DEFAULT */
    dpl_skip_desc skip;  /**< default off */
} dpl_cascades_desc;

/** One level of a schedule. */
typedef struct dpl_schedule_level {
    int32_t probes_x;   /**< probes in a row */
    int32_t probes_y;   /**< rows of probes */
    double spacing;     /**< between probes [px] */
    int32_t directions; /**< rays per probe */
    int32_t slots; /**< directions stored per probe: directions / DPL_BRANCHING, each the mean of its rays */
    double t0;     /**< where rays begin [px] */
    double t1;     /**< where rays end [px] */
    int32_t aims;  /**< rays traced per direction: 4 for DPL_MERGE_BILINEAR_FIX below the top, else 1 */
    int64_t rays;  /**< traced in this level when nothing is skipped */
    int64_t bytes; /**< radiance of this level, without what borders its rows [byte] */
} dpl_schedule_level;

/** A whole schedule. */
typedef struct dpl_schedule {
    int32_t width;                             /**< of the picture [px] */
    int32_t height;                            /**< of the picture [px] */
    int32_t level_count;                       /**< 1 .. DPL_MAX_LEVELS */
    dpl_merge merge;                           /**< as asked for */
    int64_t rays;                              /**< sum over levels */
    dpl_schedule_level levels[DPL_MAX_LEVELS]; /**< level 0 first */
} dpl_schedule;

/**
 * Computes the schedule for a picture.
 * @param desc     NULL means all defaults
 * @param width    of the picture, 1 .. 16384 [px]
 * @param height   of the picture, 1 .. 16384 [px]
 * @param schedule receives it
 * @return DPL_OK; DPL_ERROR_ARGUMENT, _SIZE. Thread-safe.
 */
DPL_API DPL_MUST_CHECK dpl_status dpl_schedule_compute(const dpl_cascades_desc *desc, int32_t width,
                                                       int32_t height, dpl_schedule *schedule);

/** Name of a merge as the command line spells it: "bilinear", "bilinear-fix", "nearest-fix", or "?". */
DPL_API const char *dpl_merge_name(dpl_merge merge);

#ifdef __cplusplus
}
#endif
#endif
