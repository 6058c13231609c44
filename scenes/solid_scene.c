/* Scenes in space: freeing, and triangles put together. */
#include "solid_scene.h"

#include <stdlib.h>
#include <string.h>

void dpl_solid_scene_free(dpl_solid_scene *scene) {
    dpl_mesh_data_free(&scene->casting);
    dpl_mesh_data_free(&scene->others);
    free(scene->parts);
    free(scene->lights);
    *scene = (dpl_solid_scene){.part_count = 0};
}

const dpl_solid_part *dpl_solid_scene_part(const dpl_solid_scene *scene, int32_t triangle) {
    bool casts = triangle < scene->casting.triangle_count;
    int32_t number = casts ? triangle : triangle - scene->casting.triangle_count;
    for (int32_t i = 0; i < scene->part_count; i++) {
        const dpl_solid_part *part = &scene->parts[i];
        if (part->casts == casts && number >= part->first && number < part->first + part->count)
            return part;
    }
    return NULL;
}

static bool append(dpl_mesh_data *all, const dpl_mesh_data *more, dpl_error *error) {
    if (!dpl_mesh_data_reserve(all, more->vertex_count, more->triangle_count, error))
        return false;
    int32_t first = all->vertex_count;
    if (more->vertex_count > 0)
        memcpy(all->vertices + first, more->vertices, (size_t)more->vertex_count * sizeof *more->vertices);
    all->vertex_count += more->vertex_count;
    for (int32_t i = 0; i < more->triangle_count; i++) {
        const int32_t *corner = more->indices[i];
        dpl_mesh_data_add_triangle(all, first + corner[0], first + corner[1], first + corner[2]);
    }
    return true;
}

bool dpl_solid_scene_join(const dpl_solid_scene *scene, dpl_mesh_data *all, dpl_error *error) {
    *all = (dpl_mesh_data){0};
    if (append(all, &scene->casting, error) && append(all, &scene->others, error))
        return true;
    dpl_mesh_data_free(all);
    return false;
}
