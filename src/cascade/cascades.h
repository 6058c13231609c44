/* The cascade solver's state, shared by cascades.c (planning and solving) and choose.c (picking a skip mode).
 */
#ifndef DPL_CASCADE_CASCADES_H
#define DPL_CASCADE_CASCADES_H

#include "cascade/level.h"
#include "cascade/survey.h"
#include "solver/solver.h"

typedef struct dpl_cascades {
    dpl_solver head;
    dpl_schedule schedule;               /* of the last size */
    dpl_buffer directions;               /* float[2] in steps of half a ray, all levels one after another */
    dpl_buffer radiance[DPL_MAX_LEVELS]; /* of level n in [n] where frames are kept, else in [n % 2] */
    dpl_buffer changed[2];               /* masks of dirty.h, where frames are kept: of level n in [n % 2] */
    dpl_buffer rows;                     /* of the output pass: 3 rows of pixels per worker */
    int32_t steps[DPL_MAX_LEVELS];       /* skip factor per level, of this frame */
    int32_t kept_steps[DPL_MAX_LEVELS];  /* of the frame that `radiance` holds */
    bool kept;                           /* it holds all levels of one */
    bool partial;                        /* and this frame is made from it */
    bool surveyed;                       /* `survey` is that of this frame */
    dpl_survey survey;                   /* of DPL_SKIP_EXACT and DPL_SKIP_BOUNDED */
} dpl_cascades;

/* Does this solver keep the radiance of all levels, to solve only what has changed? Not where rays are left
 * out by what a frame shows, nor in the paper profile, which looks at a frame before it is solved. */
bool dpl_cascades_keeps_levels(const dpl_cascades *c);

/* Radiance of level n. */
static inline float *dpl_cascades_radiance(const dpl_cascades *c, int32_t n) {
    return c->radiance[dpl_cascades_keeps_levels(c) ? n : n % 2].data;
}

/* Solves level n with the steps of this frame; `rays` receives the rays that were traced. `done` is the share
 * of the frame that is behind, for the progress hook, `more` this level's share. */
DPL_MUST_CHECK dpl_status dpl_cascades_solve_level(dpl_cascades *c, const dpl_field *field, int32_t n,
                                                   double done, double more, int64_t *rays);

/* survey.c: finds out which rays of this frame need not be traced and what the rest hits. Sets the `traced`
 * of every level's stats. */
DPL_MUST_CHECK dpl_status dpl_cascades_survey(dpl_cascades *c, const dpl_field *field);

/* choose.c: measures the signals where they are wanted, settles the mode, and sets the steps of this frame.
 * Fills stats.skip. Radiance of levels is scratch to it. */
DPL_MUST_CHECK dpl_status dpl_cascades_choose(dpl_cascades *c, const dpl_field *field);

#endif
