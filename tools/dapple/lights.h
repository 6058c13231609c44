/* The lights of a scene as the library wants them. Used by `dapple shadow` and `dapple render`. */
#ifndef DPL_TOOL_LIGHTS_H
#define DPL_TOOL_LIGHTS_H

#include "scenes/scene.h"

#include <dapple/shadow.h>

/* One per light of the scene, malloc'ed, or NULL. */
dpl_light *dpl_lights_of_scene(const dpl_scene *scene);

#endif
