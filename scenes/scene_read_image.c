/* Reads one image entry and loads its pictures. Called by scene_read.c. */
#include "scene_read.h"

#include <stdlib.h>
#include <string.h>

char *dpl_scene_path_beside(const char *scene, const char *name) {
    const char *slash = strrchr(scene, '/');
    size_t folder = slash && name[0] != '/' ? (size_t)(slash - scene) + 1 : 0;
    char *path = malloc(folder + strlen(name) + 1);
    if (path) {
        memcpy(path, scene, folder);
        memcpy(path + folder, name, strlen(name) + 1);
    }
    return path;
}

static bool load(const dpl_json_node *node, const char *name, dpl_picture_colour colour,
                 dpl_scene_picture_reader read_picture, dpl_picture *picture) {
    dpl_error error = {.text = ""};
    char *path = dpl_scene_path_beside(node->document->name, name);
    if (!path)
        return dpl_json_fail(node, "out of memory");
    bool good = read_picture(path, colour, picture, &error);
    free(path);
    return good || dpl_json_fail(node, "%s", error.text);
}

/* One of the three pictures, if the entry has it. */
static bool read_part(const dpl_json_node *entry, const char *key, dpl_picture_colour colour,
                      dpl_scene_picture_reader read_picture, char **name, dpl_picture *picture) {
    dpl_json_node node;
    const char *text;
    if (!dpl_json_member(entry, key, &node))
        return true;
    if (!dpl_json_string(&node, &text))
        return false;
    if (!(*name = malloc(strlen(text) + 1)))
        return dpl_json_fail(&node, "out of memory");
    memcpy(*name, text, strlen(text) + 1);
    return load(&node, text, colour, read_picture, picture);
}

/* Does the picture under `key` have the size of the one under `first_key`? Fine when either is missing. */
static bool same_size(const dpl_json_node *entry, const char *first_key, const dpl_picture *first,
                      const char *key, const dpl_picture *picture) {
    dpl_json_node node;
    if (!first->data || !picture->data ||
        (first->width == picture->width && first->height == picture->height))
        return true;
    dpl_json_member(entry, key, &node);
    return dpl_json_fail(&node, "is %dx%d px, but %s is %dx%d px", picture->width, picture->height, first_key,
                         first->width, first->height);
}

static bool read_pictures(const dpl_json_node *node, dpl_scene_picture_reader read_picture,
                          dpl_scene_image *image) {
    return read_part(node, "emission", DPL_PICTURE_LINEAR, read_picture, &image->emission,
                     &image->emission_picture) &&
           read_part(node, "extinction", DPL_PICTURE_RAW, read_picture, &image->extinction,
                     &image->extinction_picture) &&
           read_part(node, "albedo", DPL_PICTURE_LINEAR, read_picture, &image->albedo,
                     &image->albedo_picture) &&
           same_size(node, "emission", &image->emission_picture, "extinction", &image->extinction_picture) &&
           same_size(node, "emission", &image->emission_picture, "albedo", &image->albedo_picture) &&
           same_size(node, "extinction", &image->extinction_picture, "albedo", &image->albedo_picture);
}

static bool read_at(const dpl_json_node *node, int32_t at[2]) {
    dpl_json_node list;
    if (!dpl_json_member(node, "at", &list))
        return true;
    double any[2];
    if (!dpl_json_numbers(&list, 2, -DPL_SCENE_FAR, DPL_SCENE_FAR, any))
        return false;
    for (size_t i = 0; i < 2; i++) {
        dpl_json_node item = dpl_json_item(&list, i);
        if (!dpl_json_whole(&item, -(int32_t)DPL_SCENE_FAR, (int32_t)DPL_SCENE_FAR, &at[i]))
            return false;
    }
    return true;
}

bool dpl_scene_read_image(const dpl_json_node *node, dpl_scene_picture_reader read_picture,
                          dpl_scene_image *image) {
    static const char *const keys[] = {"emission", "extinction", "albedo", "at", "intensity", NULL};
    dpl_json_node part;
    image->intensity = 1;
    if (!dpl_json_object(node, keys))
        return false;
    if (!dpl_json_member(node, "emission", &part) && !dpl_json_member(node, "extinction", &part))
        return dpl_json_fail(node, "needs an emission or an extinction picture (has none)");
    return read_at(node, image->at) &&
           dpl_scene_read_positive(node, "intensity", DPL_SCENE_BRIGHT, &image->intensity) &&
           read_pictures(node, read_picture, image);
}
