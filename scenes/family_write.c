/* Writes families into a folder: scene files and the PNGs that they name. Called by the command line tool. */
#define _POSIX_C_SOURCE 200809L
#include "families.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

/* Longest path that is written [byte]. */
#define PATH_SIZE 4096

/* Puts "DIRECTORY/NAME" together. */
static bool join(char path[PATH_SIZE], const char *directory, const char *name, dpl_error *error) {
    size_t length = strlen(directory);
    const char *slash = length > 0 && directory[length - 1] == '/' ? "" : "/";
    int needed = snprintf(path, PATH_SIZE, "%s%s%s", directory, slash, name);
    return (needed > 0 && needed < PATH_SIZE) || dpl_error_set(error, "%s: the path is too long", directory);
}

/* What a PNG reader turns back into `value`: alpha and raw values as they are, colour sRGB-encoded. */
static uint8_t byte_of(float value, bool raw) {
    double v = value;
    if (!raw)
        v = v <= 0.0031308 ? v * 12.92 : 1.055 * pow(v, 1 / 2.4) - 0.055;
    return (uint8_t)(fmin(fmax(v, 0), 1) * 255 + 0.5);
}

static bool write_picture(const dpl_picture *picture, const char *name, const char *directory,
                          dpl_error *error) {
    char path[PATH_SIZE];
    if (!picture->data || !name)
        return true;
    if (!join(path, directory, name, error))
        return false;
    size_t count = (size_t)picture->width * (size_t)picture->height * (size_t)picture->channels;
    uint8_t *bytes = malloc(count);
    if (!bytes)
        return dpl_error_set(error, "%s: out of memory", path);
    for (size_t i = 0; i < count; i++) {
        bool alpha = picture->channels == 4 && i % 4 == 3;
        bytes[i] = byte_of(picture->data[i], alpha || picture->display);
    }
    bool good = dpl_picture_write_png(path, picture->width, picture->height, picture->channels, bytes, error);
    free(bytes);
    return good;
}

static bool write_scene(const dpl_scene *scene, const char *directory, const char *name, dpl_error *error) {
    char path[PATH_SIZE];
    for (int32_t i = 0; i < scene->image_count; i++) {
        const dpl_scene_image *image = &scene->images[i];
        if (!write_picture(&image->emission_picture, image->emission, directory, error) ||
            !write_picture(&image->extinction_picture, image->extinction, directory, error) ||
            !write_picture(&image->albedo_picture, image->albedo, directory, error))
            return false;
    }
    return join(path, directory, name, error) && dpl_scene_write(path, scene, error);
}

bool dpl_scene_family_write(const dpl_scene_family *family, uint64_t seed, int32_t size,
                            const char *directory, dpl_error *error) {
    if (mkdir(directory, 0777) != 0 && errno != EEXIST)
        return dpl_error_set(error, "%s: %s", directory, strerror(errno));
    for (int32_t i = 0; i < family->count; i++) {
        dpl_scene scene;
        char name[64];
        snprintf(name, sizeof name, "%s-%02d.json", family->name, i);
        if (!family->make(seed, i, size, &scene, error))
            return false;
        bool good = write_scene(&scene, directory, name, error);
        dpl_scene_free(&scene);
        if (!good)
            return false;
    }
    return true;
}
