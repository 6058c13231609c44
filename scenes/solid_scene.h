/* Scenes in space as data: meshes, lights, a camera. Used by tools, tests and bench; not part of the core
 * library. */
#ifndef DPL_SCENES_SOLID_SCENE_H
#define DPL_SCENES_SOLID_SCENE_H

#include "../meshes/mesh_data.h"

#include <dapple/solid_shadow.h>

/* One mesh of the scene: triangles first .. first + count - 1 of those that cast, or of those that do not. */
typedef struct dpl_solid_part {
    float albedo[3];
    bool casts;
    int32_t first;
    int32_t count;
} dpl_solid_part;

/* Owns everything. Zero-initialise; free with dpl_solid_scene_free(). */
typedef struct dpl_solid_scene {
    dpl_solid_camera camera;
    float background[3]; /* linear radiance where nothing is seen */
    float ambient[3];    /* irradiance from everywhere */
    dpl_mesh_data casting;
    dpl_mesh_data others; /* seen, and shadowed, but casting nothing */
    dpl_solid_part *parts;
    int32_t part_count;
    dpl_solid_light *lights;
    int32_t light_count;
} dpl_solid_scene;

/* Reads a scene file with "dapple3d": 1. Errors are "FILE:LINE:COL: KEY: what"; mesh files are loaded, and
 * their errors stand at their key. docs/algorithms/solid-shadows.md describes the format. */
bool dpl_solid_scene_read(const char *path, dpl_solid_scene *scene, dpl_error *error);

/* The same from memory: `path` stands for the file in errors and is where mesh files are looked up. */
bool dpl_solid_scene_read_memory(const void *bytes, size_t size, const char *path, dpl_solid_scene *scene,
                                 dpl_error *error);

/* Does a text say "dapple3d"? To tell which kind of scene a file is before reading it. */
bool dpl_solid_scene_is_one(const void *bytes, size_t size);

void dpl_solid_scene_free(dpl_solid_scene *scene);

/* The part that a triangle is of, by its number among the casting ones or, beyond them, the others. */
const dpl_solid_part *dpl_solid_scene_part(const dpl_solid_scene *scene, int32_t triangle);

/* All triangles, those that cast first: what a camera looks at. */
bool dpl_solid_scene_join(const dpl_solid_scene *scene, dpl_mesh_data *all, dpl_error *error);

#endif
