/* Reads scene files of scenes in space. Called by the tools, tests and bench. */
#include "scene_read.h"
#include "solid_scene.h"

#include "../image/file.h"
#include "../meshes/mesh_file.h"

#include <stdlib.h>
#include <string.h>

#define FARTHEST 1e6

static bool no_memory(const dpl_json_node *node) {
    return dpl_error_set(node->document->error, "%s: out of memory", node->document->name);
}

/* ---- numbers -------------------------------------------------------------------------------------- */

static void to_floats(const double *from, float to[3]) {
    for (int i = 0; i < 3; i++)
        to[i] = (float)from[i];
}

/* Leaves *vector alone when the key is missing. */
static bool read_vector(const dpl_json_node *object, const char *key, float vector[3]) {
    dpl_json_node node;
    double numbers[3];
    if (!dpl_json_member(object, key, &node))
        return true;
    if (!dpl_json_numbers(&node, 3, -FARTHEST, FARTHEST, numbers))
        return false;
    to_floats(numbers, vector);
    return true;
}

static bool require_vector(const dpl_json_node *object, const char *key, float vector[3]) {
    dpl_json_node node;
    return dpl_json_require(object, key, &node) && read_vector(object, key, vector);
}

static bool read_number(const dpl_json_node *object, const char *key, double least, double most,
                        float *number) {
    dpl_json_node node;
    double value;
    if (!dpl_json_member(object, key, &node))
        return true;
    if (!dpl_json_number(&node, least, most, &value))
        return false;
    *number = (float)value;
    return true;
}

static bool read_colour(const dpl_json_node *object, const char *key, double most, float rgb[3]) {
    double value[3] = {(double)rgb[0], (double)rgb[1], (double)rgb[2]};
    if (!dpl_scene_read_rgb(object, key, most, value))
        return false;
    to_floats(value, rgb);
    return true;
}

/* ---- camera --------------------------------------------------------------------------------------- */

static bool read_size(const dpl_json_node *root, dpl_solid_camera *camera) {
    dpl_json_node node;
    double any[2];
    if (!dpl_json_member(root, "size", &node))
        return true;
    if (!dpl_json_numbers(&node, 2, -INFINITY, INFINITY, any))
        return false;
    dpl_json_node width = dpl_json_item(&node, 0), height = dpl_json_item(&node, 1);
    return dpl_json_whole(&width, 1, DPL_MAX_SIZE, &camera->width) &&
           dpl_json_whole(&height, 1, DPL_MAX_SIZE, &camera->height);
}

static bool read_camera(const dpl_json_node *root, dpl_solid_camera *camera) {
    static const char *const keys[] = {"eye", "target", "up", "angle", NULL};
    dpl_json_node node;
    *camera = dpl_solid_camera_default();
    return read_size(root, camera) && dpl_json_require(root, "camera", &node) &&
           dpl_json_object(&node, keys) && require_vector(&node, "eye", camera->eye) &&
           require_vector(&node, "target", camera->target) && read_vector(&node, "up", camera->up) &&
           read_number(&node, "angle", 0.001, 3.0, &camera->angle);
}

/* ---- lights --------------------------------------------------------------------------------------- */

static bool read_spot(const dpl_json_node *node, dpl_solid_light *light) {
    static const char *const keys[] = {"position", "direction", "radius", "angle", NULL};
    return dpl_json_object(node, keys) && require_vector(node, "position", light->position) &&
           require_vector(node, "direction", light->direction) &&
           read_number(node, "radius", 1e-6, FARTHEST, &light->radius) &&
           read_number(node, "angle", 0.01, 1.4, &light->angle);
}

static bool read_point(const dpl_json_node *node, dpl_solid_light *light) {
    static const char *const keys[] = {"position", "radius", NULL};
    return dpl_json_object(node, keys) && require_vector(node, "position", light->position) &&
           read_number(node, "radius", 1e-6, FARTHEST, &light->radius);
}

static bool read_directional(const dpl_json_node *node, dpl_solid_light *light) {
    static const char *const keys[] = {"direction", "radius", NULL};
    light->radius = 0.005f;
    return dpl_json_object(node, keys) && require_vector(node, "direction", light->direction) &&
           read_number(node, "radius", 1e-6, 1.0, &light->radius);
}

/* One of several members that say what an entry is. */
typedef struct kind_entry {
    const char *key;
    int kind;
} kind_entry;

/* Finds the one member that the list names; lists end with a NULL key. */
static bool find_kind(const dpl_json_node *node, const kind_entry *list, const char *names,
                      const kind_entry **found, dpl_json_node *member) {
    *found = NULL;
    for (; list->key; list++) {
        dpl_json_node other;
        if (!dpl_json_member(node, list->key, &other))
            continue;
        if (*found)
            return dpl_json_fail_key(node, list->key, "is a second kind beside %s", (*found)->key);
        *found = list;
        *member = other;
    }
    return *found || dpl_json_fail(node, "must have one of %s", names);
}

static bool read_light(const dpl_json_node *node, dpl_solid_light *light) {
    static const char *const keys[] = {"spot", "point", "directional", "color", "intensity", NULL};
    static const kind_entry kinds[] = {{"spot", DPL_SOLID_LIGHT_SPOT},
                                       {"point", DPL_SOLID_LIGHT_POINT},
                                       {"directional", DPL_SOLID_LIGHT_DIRECTIONAL},
                                       {NULL, 0}};
    static bool (*const readers[])(const dpl_json_node *, dpl_solid_light *) = {read_spot, read_point,
                                                                                read_directional};
    const kind_entry *kind;
    dpl_json_node shape;
    *light = dpl_solid_light_default();
    if (!dpl_json_object(node, keys) || !find_kind(node, kinds, "spot, point, directional", &kind, &shape))
        return false;
    light->kind = (dpl_solid_light_kind)kind->kind;
    if (!readers[kind->kind](&shape, light))
        return false;
    if (!(fabsf(light->direction[0]) + fabsf(light->direction[1]) + fabsf(light->direction[2]) > 1e-5f))
        return dpl_json_fail_key(&shape, "direction", "must not be nothing");
    return read_colour(node, "color", DPL_SCENE_BRIGHT, light->color) &&
           read_number(node, "intensity", 0.0, DPL_SCENE_BRIGHT, &light->intensity);
}

/* An optional array and memory for its entries; *count is 0 when the key is missing. */
static bool read_list(const dpl_json_node *root, const char *key, size_t entry, dpl_json_node *list,
                      size_t *count, void **entries) {
    *count = 0;
    if (!dpl_json_member(root, key, list))
        return true;
    if (!dpl_json_array(list, 0))
        return false;
    *count = dpl_json_count(list);
    if (*count > INT32_MAX)
        return dpl_json_fail(list, "too many entries");
    *entries = calloc(*count + 1, entry);
    return *entries || no_memory(root);
}

static bool read_lights(const dpl_json_node *root, dpl_solid_scene *scene) {
    dpl_json_node list;
    size_t count;
    void *entries = NULL;
    bool good = read_list(root, "lights", sizeof *scene->lights, &list, &count, &entries);
    scene->lights = entries;
    for (size_t i = 0; i < count && good; i++, scene->light_count++) {
        dpl_json_node item = dpl_json_item(&list, i);
        good = read_light(&item, &scene->lights[i]);
    }
    return good;
}

/* ---- meshes --------------------------------------------------------------------------------------- */

typedef enum mesh_kind { MESH_FILE, MESH_SPHERE, MESH_BOX, MESH_PLANE } mesh_kind;

static bool read_transform(const dpl_json_node *node, dpl_mesh_transform *transform) {
    double scale[3] = {1, 1, 1}, angles[3] = {0}, move[3] = {0};
    dpl_json_node member;
    if (dpl_json_member(node, "scale", &member)) {
        bool good = dpl_json_is_array(&member) ? dpl_json_numbers(&member, 3, -FARTHEST, FARTHEST, scale)
                                               : dpl_json_number(&member, -FARTHEST, FARTHEST, &scale[0]);
        if (!good)
            return false;
        for (int axis = 1; axis < 3 && !dpl_json_is_array(&member); axis++)
            scale[axis] = scale[0];
    }
    if (dpl_json_member(node, "rotate", &member) && !dpl_json_numbers(&member, 3, -1e3, 1e3, angles))
        return false;
    if (dpl_json_member(node, "move", &member) && !dpl_json_numbers(&member, 3, -FARTHEST, FARTHEST, move))
        return false;
    *transform = dpl_mesh_transform_of(scale, angles, move);
    return true;
}

static bool read_file(const dpl_json_node *node, const dpl_mesh_transform *transform, dpl_mesh_data *data) {
    const char *name;
    dpl_error error = {.text = ""};
    if (!dpl_json_string(node, &name))
        return false;
    char *path = dpl_scene_path_beside(node->document->name, name);
    if (!path)
        return no_memory(node);
    bool good = dpl_mesh_file_read(path, transform, data, &error);
    free(path);
    return good || dpl_json_fail(node, "%s", error.text);
}

/* The unit sphere, box or plane, of the size and at the place that its object says, then transformed. */
static bool read_built_in(const dpl_json_node *node, mesh_kind kind, const dpl_mesh_transform *outer,
                          dpl_mesh_data *data) {
    static const char *const sphere_keys[] = {"center", "radius", "rings", NULL};
    static const char *const flat_keys[] = {"center", "half", NULL};
    double center[3] = {0}, half[3] = {1, 1, 1};
    int32_t rings = 32;
    dpl_json_node member;
    if (!dpl_json_object(node, kind == MESH_SPHERE ? sphere_keys : flat_keys))
        return false;
    if (dpl_json_member(node, "center", &member) &&
        !dpl_json_numbers(&member, 3, -FARTHEST, FARTHEST, center))
        return false;
    if (dpl_json_member(node, "radius", &member) && !dpl_json_number(&member, 1e-6, FARTHEST, &half[0]))
        return false;
    if (dpl_json_member(node, "rings", &member) && !dpl_json_whole(&member, 3, 1024, &rings))
        return false;
    if (dpl_json_member(node, "half", &member) && !dpl_json_numbers(&member, 3, 0, FARTHEST, half))
        return false;
    dpl_mesh_transform transform = *outer;
    for (int row = 0; row < 3; row++)
        for (int column = 0; column < 3; column++) {
            transform.move[row] += outer->turn[row][column] * center[column];
            transform.turn[row][column] *= kind == MESH_SPHERE ? half[0] : half[column];
        }
    dpl_error *error = node->document->error;
    if (kind == MESH_SPHERE)
        return dpl_mesh_data_add_sphere(data, &transform, rings, error);
    return kind == MESH_BOX ? dpl_mesh_data_add_box(data, &transform, error)
                            : dpl_mesh_data_add_plane(data, &transform, error);
}

static bool read_mesh(const dpl_json_node *node, dpl_solid_scene *scene, dpl_solid_part *part) {
    static const char *const keys[] = {"file", "sphere", "box",    "plane", "scale",
                                       "move", "rotate", "albedo", "casts", NULL};
    static const kind_entry kinds[] = {
        {"file", MESH_FILE}, {"sphere", MESH_SPHERE}, {"box", MESH_BOX}, {"plane", MESH_PLANE}, {NULL, 0}};
    const kind_entry *kind;
    dpl_json_node shape, member;
    dpl_mesh_transform transform;
    int32_t casts = 1;
    *part = (dpl_solid_part){.albedo = {0.8f, 0.8f, 0.8f}};
    if (!dpl_json_object(node, keys) || !find_kind(node, kinds, "file, sphere, box, plane", &kind, &shape) ||
        !read_transform(node, &transform) || !read_colour(node, "albedo", 1.0, part->albedo))
        return false;
    if (dpl_json_member(node, "casts", &member) && !dpl_json_whole(&member, 0, 1, &casts))
        return false;
    dpl_mesh_data *data = casts ? &scene->casting : &scene->others;
    part->casts = casts != 0;
    part->first = data->triangle_count;
    bool good = kind->kind == MESH_FILE ? read_file(&shape, &transform, data)
                                        : read_built_in(&shape, (mesh_kind)kind->kind, &transform, data);
    part->count = data->triangle_count - part->first;
    return good;
}

static bool read_meshes(const dpl_json_node *root, dpl_solid_scene *scene) {
    dpl_json_node list, required;
    size_t count;
    void *entries = NULL;
    if (!dpl_json_require(root, "meshes", &required))
        return false;
    bool good = read_list(root, "meshes", sizeof *scene->parts, &list, &count, &entries);
    scene->parts = entries;
    for (size_t i = 0; i < count && good; i++, scene->part_count++) {
        dpl_json_node item = dpl_json_item(&list, i);
        good = read_mesh(&item, scene, &scene->parts[i]);
    }
    if (good && scene->casting.triangle_count == 0)
        return dpl_json_fail(&list, "needs at least one mesh that casts shadows");
    return good;
}

/* ---- the whole ------------------------------------------------------------------------------------ */

static bool read_version(const dpl_json_node *root) {
    dpl_json_node node;
    double version;
    if (!dpl_json_require(root, "dapple3d", &node) || !dpl_json_number(&node, -1e9, 1e9, &version))
        return false;
    if (version < 1 || version > 1)
        return dpl_json_fail(&node, "must be 1, the only version of the format there is");
    return true;
}

/* Meshes come last: nothing is opened for a scene that is wrong anyway. */
static bool read_root(const dpl_json_node *root, dpl_solid_scene *scene) {
    static const char *const keys[] = {"dapple3d", "size",   "background", "ambient",
                                       "camera",   "lights", "meshes",     NULL};
    return dpl_json_object(root, keys) && read_version(root) && read_camera(root, &scene->camera) &&
           read_colour(root, "background", DPL_SCENE_BRIGHT, scene->background) &&
           read_colour(root, "ambient", DPL_SCENE_BRIGHT, scene->ambient) && read_lights(root, scene) &&
           read_meshes(root, scene);
}

bool dpl_solid_scene_read_memory(const void *bytes, size_t size, const char *path, dpl_solid_scene *scene,
                                 dpl_error *error) {
    dpl_json_document document = {path, bytes, size, error};
    json_t *value;
    *scene = (dpl_solid_scene){.part_count = 0};
    if (size == 0)
        return dpl_error_set(error, "%s: is empty, not a scene", path);
    if (memchr(bytes, '\0', size))
        return dpl_error_set(error, "%s: is not JSON text", path);
    if (!dpl_json_parse(&document, &value))
        return false;
    dpl_json_node root = dpl_json_root(&document, value);
    bool good = read_root(&root, scene);
    json_decref(value);
    if (!good)
        dpl_solid_scene_free(scene);
    return good;
}

bool dpl_solid_scene_read(const char *path, dpl_solid_scene *scene, dpl_error *error) {
    char *bytes;
    size_t size;
    *scene = (dpl_solid_scene){.part_count = 0};
    if (!dpl_file_read(path, DPL_SCENE_FILE_LIMIT, &bytes, &size, error))
        return false;
    bool good = dpl_solid_scene_read_memory(bytes, size, path, scene, error);
    free(bytes);
    return good;
}

bool dpl_solid_scene_is_one(const void *bytes, size_t size) {
    static const char key[] = "\"dapple3d\"";
    const char *text = bytes;
    for (size_t i = 0; i + sizeof key - 1 <= size; i++)
        if (memcmp(text + i, key, sizeof key - 1) == 0)
            return true;
    return false;
}
