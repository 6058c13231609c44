/* Lights the world of a session, and says how it went. Called by web/module/core.js. */
#ifndef DPL_WEB_SOLVE_H
#define DPL_WEB_SOLVE_H

#include "session.h"

/* Numbers that dpl_web_stats() gives before those of the levels, and for each level. Their order is that of
 * web/module/stats.js. */
#define DPL_WEB_STATS 15
#define DPL_WEB_LEVEL_STATS 4

/* Solves into the light plane. A solver is kept for the next call with the same settings. */
int32_t dpl_web_solve(dpl_web_session *session, int32_t solver, int32_t bounces, int32_t merge, int32_t skip,
                      double bound_db, int32_t directions, int32_t watched, int32_t reuse);

/* What the last solve did; `values` has room for DPL_WEB_STATS + DPL_MAX_LEVELS * DPL_WEB_LEVEL_STATS. */
void dpl_web_stats(const dpl_web_session *session, double *values);

/* Adds the light of discs, as dpl_shadow_light() has it, into the light plane. `method` is a
 * dpl_shadow_method; lights are rows of x, y, radius, red, green, blue, intensity. */
int32_t dpl_web_shadow(dpl_web_session *session, int32_t method, const double *lights, int32_t count);

#endif
