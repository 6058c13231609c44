/* Owning a scene's parts. Used by everything that makes scenes. */
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
    free(scene->sky_ring);
    memset(scene, 0, sizeof *scene);
}

static bool grow_shapes(dpl_scene *scene, dpl_error *error) {
    if (scene->shape_count < scene->shape_capacity)
        return true;
    if (scene->shape_capacity > INT32_MAX / 2)
        return dpl_error_set(error, "too many shapes");
    int32_t capacity = scene->shape_capacity > 0 ? 2 * scene->shape_capacity : 16;
    dpl_shape *shapes = realloc(scene->shapes, (size_t)capacity * sizeof *shapes);
    if (!shapes)
        return dpl_error_set(error, "out of memory");
    scene->shapes = shapes;
    scene->shape_capacity = capacity;
    return true;
}

bool dpl_scene_add_shape(dpl_scene *scene, const dpl_shape *shape, dpl_error *error) {
    if (!grow_shapes(scene, error))
        return false;
    dpl_shape copy = *shape;
    if (shape->kind == DPL_SHAPE_POLYGON) {
        size_t bytes = (size_t)shape->polygon.count * sizeof *shape->polygon.points;
        double(*points)[2] = malloc(bytes > 0 ? bytes : 1);
        if (!points)
            return dpl_error_set(error, "out of memory");
        if (bytes > 0)
            memcpy(points, shape->polygon.points, bytes);
        copy.polygon.points = (const double(*)[2])points;
    }
    scene->shapes[scene->shape_count++] = copy;
    return true;
}
