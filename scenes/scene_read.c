/* Reads scene files: the top level, lights, and PNGs taken as scenes. Called by the tools, tests and bench.
 */
#include "scene_read.h"

#include "../image/file.h"

#include <stdlib.h>
#include <string.h>

bool dpl_scene_read_rgb(const dpl_json_node *object, const char *key, double most, double rgb[3]) {
    dpl_json_node node;
    return !dpl_json_member(object, key, &node) || dpl_json_rgb(&node, 0, most, rgb);
}

bool dpl_scene_read_positive(const dpl_json_node *object, const char *key, double most, double *number) {
    dpl_json_node node;
    return !dpl_json_member(object, key, &node) || dpl_json_number(&node, 0, most, number);
}

bool dpl_scene_read_light(const dpl_json_node *node, dpl_scene_light *light) {
    static const char *const keys[] = {"position", "radius", "color", "intensity", NULL};
    dpl_json_node position, radius;
    *light = (dpl_scene_light){.color = {1, 1, 1}, .intensity = 1};
    return dpl_json_object(node, keys) && dpl_json_require(node, "position", &position) &&
           dpl_json_numbers(&position, 2, -DPL_SCENE_FAR, DPL_SCENE_FAR, light->position) &&
           dpl_json_require(node, "radius", &radius) &&
           dpl_json_number(&radius, 0, DPL_SCENE_FAR, &light->radius) &&
           dpl_scene_read_rgb(node, "color", DPL_SCENE_BRIGHT, light->color) &&
           dpl_scene_read_positive(node, "intensity", DPL_SCENE_BRIGHT, &light->intensity);
}

static bool read_version(const dpl_json_node *root) {
    dpl_json_node node;
    double version;
    if (!dpl_json_require(root, "dapple", &node) ||
        !dpl_json_number(&node, -DPL_SCENE_FAR, DPL_SCENE_FAR, &version))
        return false;
    if (version < 1 || version > 1)
        return dpl_json_fail(&node, "must be 1, the only version of the format there is");
    return true;
}

static bool read_size(const dpl_json_node *root, dpl_scene *scene) {
    dpl_json_node node;
    double any[2];
    if (!dpl_json_require(root, "size", &node) || !dpl_json_numbers(&node, 2, -INFINITY, INFINITY, any))
        return false;
    dpl_json_node width = dpl_json_item(&node, 0), height = dpl_json_item(&node, 1);
    return dpl_json_whole(&width, 1, DPL_MAX_SIZE, &scene->width) &&
           dpl_json_whole(&height, 1, DPL_MAX_SIZE, &scene->height);
}

static bool read_margin(const dpl_json_node *root, dpl_scene *scene) {
    dpl_json_node node;
    if (!dpl_json_member(root, "margin", &node))
        return true;
    if (!dpl_json_whole(&node, 0, DPL_MAX_MARGIN, &scene->margin))
        return false;
    int32_t width = scene->width + 2 * scene->margin, height = scene->height + 2 * scene->margin;
    return (width <= DPL_MAX_SIZE && height <= DPL_MAX_SIZE) ||
           dpl_json_fail(&node, "makes a world of %d x %d px, more than %d a side", width, height,
                         DPL_MAX_SIZE);
}

/* One colour, or a list of colours: the sectors of a ring. */
static bool read_sky(const dpl_json_node *root, dpl_scene *scene) {
    dpl_json_node node;
    if (!dpl_json_member(root, "sky", &node))
        return true;
    dpl_json_node first = dpl_json_item(&node, 0);
    if (!dpl_json_is_array(&first))
        return dpl_json_rgb(&node, 0, DPL_SCENE_BRIGHT, scene->sky);
    size_t count = dpl_json_count(&node);
    if (count > DPL_MAX_SKY_SECTORS)
        return dpl_json_fail(&node, "must have at most %d sectors (has %zu)", DPL_MAX_SKY_SECTORS, count);
    if (!(scene->sky_ring = calloc(count, sizeof *scene->sky_ring)))
        return dpl_error_set(root->document->error, "%s: out of memory", root->document->name);
    scene->sky_sectors = (int32_t)count;
    for (size_t k = 0; k < count; k++) {
        dpl_json_node item = dpl_json_item(&node, k);
        if (!dpl_json_numbers(&item, 3, 0, DPL_SCENE_BRIGHT, scene->sky_ring[k]))
            return false;
    }
    return true;
}

/* An optional array; *count is 0 when the key is missing. */
static bool read_list(const dpl_json_node *root, const char *key, dpl_json_node *list, size_t *count) {
    *count = 0;
    if (!dpl_json_member(root, key, list))
        return true;
    if (!dpl_json_array(list, 0))
        return false;
    *count = dpl_json_count(list);
    return *count <= INT32_MAX || dpl_json_fail(list, "too many entries");
}

static bool read_shapes(const dpl_json_node *root, dpl_scene *scene) {
    dpl_json_node list;
    size_t count;
    if (!read_list(root, "shapes", &list, &count))
        return false;
    for (size_t i = 0; i < count; i++) {
        dpl_json_node item = dpl_json_item(&list, i);
        if (!dpl_scene_read_shape(&item, scene))
            return false;
    }
    return true;
}

static bool read_lights(const dpl_json_node *root, dpl_scene *scene) {
    dpl_json_node list;
    size_t count;
    if (!read_list(root, "lights", &list, &count))
        return false;
    if (count > 0 && !(scene->lights = calloc(count, sizeof *scene->lights)))
        return dpl_error_set(root->document->error, "%s: out of memory", root->document->name);
    for (size_t i = 0; i < count; i++) {
        dpl_json_node item = dpl_json_item(&list, i);
        if (!dpl_scene_read_light(&item, &scene->lights[i]))
            return false;
        scene->light_count++;
    }
    return true;
}

static bool read_images(const dpl_json_node *root, dpl_scene_picture_reader read_picture, dpl_scene *scene) {
    dpl_json_node list;
    size_t count;
    if (!read_list(root, "images", &list, &count))
        return false;
    if (count > 0 && !(scene->images = calloc(count, sizeof *scene->images)))
        return dpl_error_set(root->document->error, "%s: out of memory", root->document->name);
    for (size_t i = 0; i < count; i++) {
        dpl_json_node item = dpl_json_item(&list, i);
        scene->image_count++;
        if (!dpl_scene_read_image(&item, read_picture, &scene->images[i]))
            return false;
    }
    return true;
}

/* Pictures come last: nothing is opened for a scene that is wrong anyway. */
static bool read_root(const dpl_json_node *root, dpl_scene_picture_reader read_picture, dpl_scene *scene) {
    static const char *const keys[] = {"dapple", "size", "margin", "sky", "shapes", "images", "lights", NULL};
    return dpl_json_object(root, keys) && read_version(root) && read_size(root, scene) &&
           read_margin(root, scene) && read_sky(root, scene) && read_shapes(root, scene) &&
           read_lights(root, scene) && read_images(root, read_picture, scene);
}

static bool read_json(const dpl_json_document *document, dpl_scene_picture_reader read_picture,
                      dpl_scene *scene) {
    json_t *value;
    if (!dpl_json_parse(document, &value))
        return false;
    dpl_json_node root = dpl_json_root(document, value);
    bool good = read_root(&root, read_picture, scene);
    json_decref(value);
    return good;
}

/* One image, named after the file itself, so that the scene can be written beside it. */
static bool read_png(const void *bytes, size_t size, const char *path, dpl_scene *scene, dpl_error *error) {
    const char *slash = strrchr(path, '/');
    const char *name = slash ? slash + 1 : path;
    if (!(scene->images = calloc(1, sizeof *scene->images)))
        return dpl_error_set(error, "%s: out of memory", path);
    dpl_scene_image *image = scene->images;
    scene->image_count = 1;
    image->intensity = 1;
    if (!(image->emission = malloc(strlen(name) + 1)))
        return dpl_error_set(error, "%s: out of memory", path);
    memcpy(image->emission, name, strlen(name) + 1);
    if (!dpl_picture_read_memory(bytes, size, path, DPL_PICTURE_LINEAR, &image->emission_picture, error))
        return false;
    scene->width = image->emission_picture.width;
    scene->height = image->emission_picture.height;
    return true;
}

static bool read_any(const void *bytes, size_t size, const char *path, dpl_scene_picture_reader read_picture,
                     dpl_scene *scene, dpl_error *error) {
    static const char png[] = "\x89PNG\r\n\x1a\n", byte_order_mark[] = "\xef\xbb\xbf";
    dpl_json_document document = {path, bytes, size, error};
    if (size == 0)
        return dpl_error_set(error, "%s: is empty, not a scene", path);
    if (size >= 8 && memcmp(bytes, png, 8) == 0)
        return read_png(bytes, size, path, scene, error);
    if (memchr(bytes, '\0', size))
        return dpl_error_set(error, "%s: is neither JSON text nor a PNG picture", path);
    if (size >= 3 && memcmp(bytes, byte_order_mark, 3) == 0) {
        document.text += 3;
        document.size -= 3;
    }
    return read_json(&document, read_picture, scene);
}

bool dpl_scene_read_with(const void *bytes, size_t size, const char *path,
                         dpl_scene_picture_reader read_picture, dpl_scene *scene, dpl_error *error) {
    memset(scene, 0, sizeof *scene);
    if (read_any(bytes, size, path, read_picture, scene, error))
        return true;
    dpl_scene_free(scene);
    return false;
}

bool dpl_scene_read_memory(const void *bytes, size_t size, const char *path, dpl_scene *scene,
                           dpl_error *error) {
    return dpl_scene_read_with(bytes, size, path, dpl_picture_read, scene, error);
}

bool dpl_scene_read(const char *path, dpl_scene *scene, dpl_error *error) {
    char *bytes;
    size_t size;
    memset(scene, 0, sizeof *scene);
    if (!dpl_file_read(path, DPL_SCENE_FILE_LIMIT, &bytes, &size, error))
        return false;
    bool good = dpl_scene_read_memory(bytes, size, path, scene, error);
    free(bytes);
    return good;
}
