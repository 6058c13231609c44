/* From a scene to a tile world, a pixel to a cell: opaque pixels are blocks, pixels that emit are lights,
 * scene lights too, at their centre; media take light in steps of a quarter. Used by `dapple flood` and
 * benchmarks. */
#ifndef DPL_SCENES_SCENE_FLOOD_H
#define DPL_SCENES_SCENE_FLOOD_H

#include "scene.h"

#include <dapple/flood.h>

/* How light spreads. */
typedef struct dpl_scene_flood_rules {
    dpl_flood_falloff falloff;
    int32_t range; /* of the brightest light [px] */
    bool sun;      /* the scene's sky falls from above */
} dpl_scene_flood_rules;

typedef struct dpl_scene_flood {
    dpl_flood *flood;
    double brightest; /* radiance that became the full level */
    int32_t lights;
} dpl_scene_flood;

/* Makes the world; it is not solved. `field` is the scene's own, with its shapes and pictures drawn. The
 * world is the caller's to destroy, whatever comes back. */
dpl_status dpl_scene_build_flood(const dpl_scene *scene, const dpl_field *field, dpl_context *context,
                                 const dpl_scene_flood_rules *rules, dpl_scene_flood *made);

/* Reads the light as radiance in the scene's unit. */
dpl_status dpl_scene_read_flood(const dpl_scene_flood *made, const dpl_output *output);

#endif
