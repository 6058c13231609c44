/* Scene families as planes. Called by web/module/core.js. */
#ifndef DPL_WEB_SCENE_H
#define DPL_WEB_SCENE_H

#include "session.h"

/* Most lights of a scene, and numbers of each: x, y, radius, red, green, blue, intensity. */
#define DPL_WEB_LIGHTS_MAX 64
#define DPL_WEB_LIGHT_NUMBERS 7

/* A family's name, and how many scenes it has per seed. NULL and 0 behind the last. */
const char *dpl_web_family_name(int32_t family);
int32_t dpl_web_family_count(int32_t family);

/* Resizes the world and fills its planes with a scene: a square of the larger side, cut to its top left.
 * `sky` receives RGB, `lights` rows of numbers, `light_count` how many. False with a message (host.h) when it
 * fails, also for a scene that planes cannot hold: one with a margin, or a sky by direction. */
int32_t dpl_web_scene(dpl_web_session *session, int32_t family, uint64_t seed, int32_t index, int32_t width,
                      int32_t height, double sky[3], double *lights, int32_t *light_count);

#endif
