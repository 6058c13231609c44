/* See lights.h. */
#include "lights.h"

#include <stdlib.h>
#include <string.h>

dpl_light *dpl_lights_of_scene(const dpl_scene *scene) {
    dpl_light *lights = calloc((size_t)scene->light_count, sizeof *lights);
    for (int32_t i = 0; lights && i < scene->light_count; i++) {
        const dpl_scene_light *from = &scene->lights[i];
        memcpy(lights[i].position, from->position, sizeof lights[i].position);
        lights[i].radius = from->radius;
        for (int c = 0; c < 3; c++)
            lights[i].color[c] = (float)from->color[c];
        lights[i].intensity = (float)from->intensity;
    }
    return lights;
}
