/* Which rays of a row of probes come near a box. Used by the survey (trace.c), for all that is not empty, and
 * by dirty.c, for what has changed. */
#ifndef DPL_CASCADE_NEAR_H
#define DPL_CASCADE_NEAR_H

#include <dapple/schedule.h>

/* A part of the world [px]; x0 > x1 when it is nowhere. */
typedef struct dpl_ray_box {
    double x0, y0, x1, y1;
} dpl_ray_box;

/* By how much a merge may move a ray's end away from t1, in either axis [px], below the top level. */
static inline float dpl_ray_reach(const dpl_schedule_level *plan, dpl_merge merge) {
    if (merge == DPL_MERGE_BILINEAR)
        return 0.0f;
    return (float)plan->spacing * (merge == DPL_MERGE_NEAREST_FIX ? 0.5f : 1.5f);
}

/* A bound on how far a march may stray from its ray, for rounding [px]. A march keeps coordinates of the size
 * of the picture, of a probe's distance from it and of the interval's beginning, as floats of 2^-24 relative
 * precision, and computes a position from a few of them: a millionth of all together is more than ten times
 * what that can come to. What is added for worlds of any size is a sixteenth of a pixel. */
float dpl_march_margin(const dpl_schedule_level *plan, int32_t width, int32_t height);

/* Probes first .. last-1 of a row: those whose ray in this direction comes nearer to the box than `slack`, in
 * either axis, and some more. */
void dpl_rays_near(const dpl_schedule_level *plan, const float direction[2], int32_t row,
                   const dpl_ray_box *box, double slack, int32_t *first, int32_t *last);

#endif
