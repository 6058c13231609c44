/* The table of scene families. */
#include "families.h"

#include "family_list.h"

#include <string.h>

static const dpl_scene_family families[] = {
    {"arc", "the ARC paper's 50 configurations of 1-50 lights and 1-8 occluders", 50, dpl_family_arc},
    {"demo", "a house cut open at night, with fog and stained glass", 1, dpl_family_demo},
    {"pictures", "lamps, walls and paint from PNGs", 1, dpl_family_pictures},
    {"maze", "mazes with walls of 1 to 3 pixels", 10, dpl_family_maze},
    {"rooms", "rooms with doorways", 10, dpl_family_rooms},
    {"thin", "walls of one pixel, straight and slanted", 10, dpl_family_thin},
    {"tiny", "lights of 2x2 pixels", 10, dpl_family_tiny},
    {"area", "lights as large as rooms", 10, dpl_family_area},
    {"clutter", "hundreds of small occluders", 10, dpl_family_clutter},
    {"fog", "media that let some light through", 10, dpl_family_fog},
    {"bounce", "painted rooms that reflected light fills", 10, dpl_family_bounce},
    {"offscreen", "lamps outside the picture, and a sky that glows on one side", 10, dpl_family_offscreen},
    {"shadows", "one disc light among walls, to judge shadow methods", 12, dpl_family_shadows},
};

const dpl_scene_family *dpl_scene_families(int32_t *count) {
    *count = (int32_t)(sizeof families / sizeof families[0]);
    return families;
}

const dpl_scene_family *dpl_scene_family_find(const char *name) {
    for (size_t i = 0; i < sizeof families / sizeof families[0]; i++)
        if (strcmp(families[i].name, name) == 0)
            return &families[i];
    return NULL;
}
