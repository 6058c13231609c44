/* Scene families: seeded generators shared by tests, tools and benches. */
#ifndef DPL_SCENES_FAMILIES_H
#define DPL_SCENES_FAMILIES_H

#include "scene.h"

/* One family. */
typedef struct dpl_scene_family {
    const char *name;    /* as the command line spells it */
    const char *summary; /* one line for help texts */
    int32_t count;       /* scenes per seed */
    /* Makes scene `index` (0 .. count-1) of `seed`, size x size pixels unless the family says otherwise. */
    bool (*make)(uint64_t seed, int32_t index, int32_t size, dpl_scene *scene, dpl_error *error);
} dpl_scene_family;

/* All families; `count` receives how many. */
const dpl_scene_family *dpl_scene_families(int32_t *count);

/* By name, or NULL. */
const dpl_scene_family *dpl_scene_family_find(const char *name);

/* Lights and occluders of configuration `index` (0 .. 49) of the ARC paper's benchmark. */
void dpl_scene_arc_configuration(int32_t index, int32_t *lights, int32_t *occluders);

/* Writes every scene of a family as DIR/NAME-00.json … (and the PNGs that picture scenes name). */
bool dpl_scene_family_write(const dpl_scene_family *family, uint64_t seed, int32_t size,
                            const char *directory, dpl_error *error);

#endif
