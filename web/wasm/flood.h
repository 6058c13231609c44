/* A tile world lit by flood fill. Called by web/module/session.js. */
#ifndef DPL_WEB_FLOOD_H
#define DPL_WEB_FLOOD_H

#include "session.h"

/* Numbers that dpl_web_flood_update() gives: visits, pushes, removals, whether all was solved from scratch,
 * and time [ms]. */
#define DPL_WEB_FLOOD_NUMBERS 5

/* Makes a world of air; keeps the one there is when size and rules are the same. `falloff` is a
 * dpl_flood_falloff; the brightest light reaches `range` cells far, 1 .. 4096. Returns a dpl_status. */
int32_t dpl_web_flood_open(dpl_web_session *session, int32_t width, int32_t height, int32_t falloff,
                           int32_t range);

/* Planes to fill before an update: 1 where a cell is a wall, shape [height][width], and radiance >= 0 of
 * the light that stands in it, shape [height][width][3]. */
uint8_t *dpl_web_flood_walls(dpl_web_session *session);
float *dpl_web_flood_lights(dpl_web_session *session);

/* Brings the world to what the planes say, works out again what that touches, and writes the light where the
 * lights were. Returns a dpl_status. */
int32_t dpl_web_flood_update(dpl_web_session *session, double numbers[DPL_WEB_FLOOD_NUMBERS]);

#endif
