/* Owning a scene's parts. */
#include "scene.h"

#include <stdlib.h>
#include <string.h>

void dpl_scene_free(dpl_scene *scene) {
    for (int32_t i = 0; i < scene->image_count; i++) {
        dpl_scene_image *image = &scene->images[i];
        free(image->emission);
        free(image->extinction);
        free(image->albedo);
        dpl_picture_free(&image->emission_picture);
        dpl_picture_free(&image->extinction_picture);
        dpl_picture_free(&image->albedo_picture);
    }
    for (int32_t i = 0; i < scene->shape_count; i++)
        if (scene->shapes[i].kind == DPL_SHAPE_POLYGON)
            free((void *)(uintptr_t)scene->shapes[i].polygon.points);
    free(scene->images);
    free(scene->shapes);
    free(scene->lights);
    memset(scene, 0, sizeof *scene);
}
