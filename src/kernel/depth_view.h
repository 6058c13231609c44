/* A map of depths seen from a light, and receivers that look it up: types of the kernel `classify`. Made by
 * the shadows of solids. */
#ifndef DPL_KERNEL_DEPTH_VIEW_H
#define DPL_KERNEL_DEPTH_VIEW_H

#include <stdbool.h>
#include <stdint.h>

/* Most receivers at once; a multiple of the widest vector. */
#define DPL_DEPTH_MOST 64
#define DPL_DEPTH_LEVELS 13

typedef struct dpl_depth_view {
    float eye[3];
    float axis[3][3]; /* right, down, forward: depth is along the last */
    bool parallel;
    float scale;       /* texels per tangent, or per scene unit where `parallel` */
    float near;        /* nothing is nearer */
    float steepest;    /* slopes are taken to be at most this [depth/texel] */
    float cone_cosine; /* of the angle from `forward` that is lit; -1: everything before the eye */
    float light;  /* radius of the light's ball [scene unit]; tangent of half its angle where `parallel` */
    int32_t size; /* texels along a side */
    /* Nearest and farthest depth per texel, INFINITY where nothing is, and then of squares of 2 x 2, 4 x 4 …:
     * level k begins at pair first[k] and has side[k] pairs a row. */
    const float *ranges;
    int32_t first[DPL_DEPTH_LEVELS];
    int32_t side[DPL_DEPTH_LEVELS];
} dpl_depth_view;

/* What classification finds. */
typedef enum dpl_depth_class {
    DPL_DEPTH_OPEN,   /* to be looked at more closely */
    DPL_DEPTH_LIT,    /* nothing is between the receiver and any point of the disc */
    DPL_DEPTH_DARK,   /* something is before every point */
    DPL_DEPTH_OUTSIDE /* out of view, or no point at all */
} dpl_depth_class;

typedef struct dpl_depth_receivers {
    int32_t count;
    float position[3][DPL_DEPTH_MOST]; /* by axis; what is behind `count` is set to anything */
    float normal[3][DPL_DEPTH_MOST];   /* zeros: none */
    /* Results. Outside only `class` has a meaning. */
    int32_t class[DPL_DEPTH_MOST];
    int32_t rising[DPL_DEPTH_MOST]; /* -1: the whole disc is above the horizon, 0: perhaps not */
    float u[DPL_DEPTH_MOST];        /* place in the map [texel] */
    float v[DPL_DEPTH_MOST];
    float depth[DPL_DEPTH_MOST];
    float stretch[DPL_DEPTH_MOST]; /* distance over depth */
    float slope[DPL_DEPTH_MOST];   /* of the receiver's surface, along u and v added up [depth/texel] */
    float near[DPL_DEPTH_MOST];    /* nearest depth in the region that blockers can be in */
} dpl_depth_receivers;

/* ---- constants of the method, for scalars and vectors --------------------------------------------- */

/* How often the region is made smaller: a receiver's own tilted surface is left behind by then. */
#define DEPTH_ROUNDS 4

/* Pairs that a region is read from, along each axis. */
#define DEPTH_READS 5

/* Beside the region: a texel's own width, as depths are taken in texels' middles. */
#define DEPTH_TEXEL 1.0f

/* Depths that differ by less than this share of them are the same. */
#define DEPTH_SAME 1e-4f

/* Surfaces edge on: keeps slopes finite. */
#define DEPTH_LEAST_TURN 1e-20f

#endif
