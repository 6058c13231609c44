/* What each family file gives to the table in families.c: functions of the type dpl_scene_family::make. */
#ifndef DPL_SCENES_FAMILY_LIST_H
#define DPL_SCENES_FAMILY_LIST_H

#include "families.h"

#define DPL_FAMILY(name)                                                                                     \
    bool dpl_family_##name(uint64_t seed, int32_t index, int32_t size, dpl_scene *scene, dpl_error *error)

DPL_FAMILY(arc);      /* family_arc.c */
DPL_FAMILY(demo);     /* family_demo.c */
DPL_FAMILY(pictures); /* family_pictures.c */
DPL_FAMILY(maze);     /* family_indoor.c */
DPL_FAMILY(rooms);
DPL_FAMILY(thin);
DPL_FAMILY(tiny); /* family_lights.c */
DPL_FAMILY(area);
DPL_FAMILY(clutter);
DPL_FAMILY(fog);       /* family_media.c */
DPL_FAMILY(bounce);    /* family_bounce.c */
DPL_FAMILY(offscreen); /* family_offscreen.c */
DPL_FAMILY(shadows);   /* family_shadows.c */

#endif
