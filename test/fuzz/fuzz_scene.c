/* Fuzz target: any bytes are a scene that keeps its promises or an error of one line, nothing leaks, and
 * nothing outside is opened: pictures come from a stand-in. */
#include "../../scenes/scene_read.h"

#include <stdint.h>
#include <stdlib.h>
#include <string.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

/* A small picture; by the length of the name, one of two sizes, or none. */
static bool read_stand_in(const char *path, dpl_picture_colour colour, dpl_picture *picture,
                          dpl_error *error) {
    size_t length = strlen(path);
    if (length % 3 == 0)
        return dpl_error_set(error, "%s: No such file or directory", path);
    if (!dpl_picture_create(picture, length % 3 == 1 ? 2 : 3, 2, 4, error))
        return false;
    picture->display = colour == DPL_PICTURE_RAW;
    return true;
}

static void require(bool condition) {
    if (!condition)
        abort();
}

/* What the writer and the field count on. */
static void check_scene(const dpl_scene *scene) {
    require(scene->width >= 1 && scene->width <= DPL_MAX_SIZE);
    require(scene->height >= 1 && scene->height <= DPL_MAX_SIZE);
    require(scene->margin >= 0 && scene->margin <= DPL_MAX_MARGIN);
    require(scene->width + 2 * scene->margin <= DPL_MAX_SIZE);
    require(scene->height + 2 * scene->margin <= DPL_MAX_SIZE);
    require(scene->sky_sectors <= DPL_MAX_SKY_SECTORS &&
            (scene->sky_sectors > 0) == (scene->sky_ring != NULL));
    for (int32_t k = 0; k < scene->sky_sectors; k++)
        for (int c = 0; c < 3; c++)
            require(scene->sky_ring[k][c] >= 0 && isfinite(scene->sky_ring[k][c]));
    for (int32_t i = 0; i < scene->shape_count; i++) {
        const dpl_shape *shape = &scene->shapes[i];
        for (int k = 0; k < 3; k++) {
            require(shape->material.emission[k] >= 0 && isfinite(shape->material.emission[k]));
            require(shape->material.extinction[k] >= 0);
            require(shape->material.albedo[k] >= 0 && shape->material.albedo[k] <= 1);
        }
        require(shape->kind != DPL_SHAPE_POLYGON || shape->polygon.count >= 3);
    }
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    dpl_scene scene;
    dpl_error error = {.text = ""};
    if (dpl_scene_read_with(data, size, "corpus.json", read_stand_in, &scene, &error)) {
        check_scene(&scene);
    } else {
        require(strncmp(error.text, "corpus.json:", 12) == 0 && !strchr(error.text, '\n'));
        require(!scene.shapes && !scene.images && !scene.lights && !scene.sky_ring);
    }
    dpl_scene_free(&scene);
    return 0;
}
