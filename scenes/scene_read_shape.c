/* Reads one shape: which of the four kinds, its geometry, its material. Called by scene_read.c. */
#include "scene_read.h"

#include <stdlib.h>
#include <string.h>

static bool require_point(const dpl_json_node *object, const char *key, double point[2]) {
    dpl_json_node node;
    return dpl_json_require(object, key, &node) &&
           dpl_json_numbers(&node, 2, -DPL_SCENE_FAR, DPL_SCENE_FAR, point);
}

static bool read_disc(const dpl_json_node *node, dpl_shape *shape) {
    static const char *const keys[] = {"center", "radius", NULL};
    dpl_json_node radius;
    return dpl_json_object(node, keys) && require_point(node, "center", shape->disc.center) &&
           dpl_json_require(node, "radius", &radius) &&
           dpl_json_number(&radius, 0, DPL_SCENE_FAR, &shape->disc.radius);
}

static bool read_box(const dpl_json_node *node, dpl_shape *shape) {
    static const char *const keys[] = {"center", "half", "angle", NULL};
    dpl_json_node half, angle;
    return dpl_json_object(node, keys) && require_point(node, "center", shape->box.center) &&
           dpl_json_require(node, "half", &half) &&
           dpl_json_numbers(&half, 2, 0, DPL_SCENE_FAR, shape->box.half) &&
           (!dpl_json_member(node, "angle", &angle) ||
            dpl_json_number(&angle, -DPL_SCENE_FAR, DPL_SCENE_FAR, &shape->box.angle));
}

static bool read_segment(const dpl_json_node *node, dpl_shape *shape) {
    static const char *const keys[] = {"from", "to", "width", NULL};
    shape->segment.width = 1;
    return dpl_json_object(node, keys) && require_point(node, "from", shape->segment.from) &&
           require_point(node, "to", shape->segment.to) &&
           dpl_scene_read_positive(node, "width", DPL_SCENE_FAR, &shape->segment.width);
}

/* The points are the shape's to free. */
static bool read_polygon(const dpl_json_node *node, dpl_shape *shape) {
    static const char *const keys[] = {"points", NULL};
    dpl_json_node list;
    if (!dpl_json_object(node, keys) || !dpl_json_require(node, "points", &list) || !dpl_json_array(&list, 3))
        return false;
    size_t count = dpl_json_count(&list);
    if (count > INT32_MAX)
        return dpl_json_fail(&list, "too many points");
    double(*points)[2] = calloc(count, sizeof *points);
    if (!points)
        return dpl_json_fail(&list, "out of memory");
    shape->polygon.points = (const double(*)[2])points;
    shape->polygon.count = (int32_t)count;
    for (size_t i = 0; i < count; i++) {
        dpl_json_node item = dpl_json_item(&list, i);
        if (!dpl_json_numbers(&item, 2, -DPL_SCENE_FAR, DPL_SCENE_FAR, points[i]))
            return false;
    }
    return true;
}

/* The four kinds, in the order in which errors name them. */
typedef struct kind_entry {
    const char *key;
    dpl_shape_kind kind;
    bool (*read)(const dpl_json_node *node, dpl_shape *shape);
} kind_entry;

static const kind_entry kinds[] = {
    {"disc", DPL_SHAPE_DISC, read_disc},
    {"box", DPL_SHAPE_BOX, read_box},
    {"polygon", DPL_SHAPE_POLYGON, read_polygon},
    {"segment", DPL_SHAPE_SEGMENT, read_segment},
};

static bool find_kind(const dpl_json_node *node, const kind_entry **kind, dpl_json_node *geometry) {
    *kind = NULL;
    for (size_t i = 0; i < sizeof kinds / sizeof kinds[0]; i++) {
        dpl_json_node member;
        if (!dpl_json_member(node, kinds[i].key, &member))
            continue;
        if (*kind)
            return dpl_json_fail_key(node, kinds[i].key,
                                     "a shape is exactly one of disc, box, polygon, segment (has %s as well)",
                                     (*kind)->key);
        *kind = &kinds[i];
        *geometry = member;
    }
    return *kind || dpl_json_fail(node, "needs exactly one of disc, box, polygon, segment (has none)");
}

static void to_float(const double from[3], float to[3]) {
    for (int i = 0; i < 3; i++)
        to[i] = (float)from[i];
}

static bool read_extinction(const dpl_json_node *node, float extinction[3]) {
    dpl_json_node member;
    double rgb[3];
    if (!dpl_json_member(node, "extinction", &member))
        return true; /* opaque by default */
    if (json_is_string(member.value)) {
        if (strcmp(json_string_value(member.value), "opaque") == 0)
            return true;
        return dpl_json_fail(&member, "must be a number, [r, g, b] or \"opaque\"");
    }
    if (!dpl_json_rgb(&member, 0, DPL_SCENE_BRIGHT, rgb))
        return false;
    to_float(rgb, extinction);
    return true;
}

static bool read_material(const dpl_json_node *node, dpl_material *material) {
    double emission[3] = {0}, albedo[3] = {0};
    if (!dpl_scene_read_rgb(node, "emission", DPL_SCENE_BRIGHT, emission) ||
        !read_extinction(node, material->extinction) || !dpl_scene_read_rgb(node, "albedo", 1, albedo))
        return false;
    to_float(emission, material->emission);
    to_float(albedo, material->albedo);
    return true;
}

bool dpl_scene_read_shape(const dpl_json_node *node, dpl_scene *scene) {
    static const char *const keys[] = {"disc",     "box",        "polygon", "segment",
                                       "emission", "extinction", "albedo",  NULL};
    const kind_entry *kind;
    dpl_json_node geometry;
    if (!dpl_json_object(node, keys) || !find_kind(node, &kind, &geometry))
        return false;
    dpl_shape shape = dpl_shape_default(kind->kind);
    bool good = kind->read(&geometry, &shape) && read_material(node, &shape.material) &&
                dpl_scene_add_shape(scene, &shape, node->document->error);
    if (shape.kind == DPL_SHAPE_POLYGON)
        free((void *)(uintptr_t)shape.polygon.points);
    return good;
}
