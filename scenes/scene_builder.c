/* Builds scenes shape by shape. No sine, cosine or power here: their last bits differ between machines. */
#include "scene_builder.h"

#include <stdlib.h>
#include <string.h>

/* FNV-1a: a family's streams come from its name, so a new family changes no other. */
static uint64_t hash_of(const char *name) {
    uint64_t hash = 0xcbf29ce484222325u;
    for (; *name; name++)
        hash = (hash ^ (unsigned char)*name) * 0x100000001b3u;
    return hash;
}

dpl_scene_builder dpl_build_start(const char *family, uint64_t seed, int32_t index, int32_t size,
                                  dpl_scene *scene, dpl_error *error) {
    dpl_scene_builder builder = {.scene = scene, .error = error, .good = true};
    memset(scene, 0, sizeof *scene);
    if (size < 1 || size > DPL_MAX_SIZE)
        builder.good =
            dpl_error_set(error, "%s: the size must be 1 to %d (is %d)", family, DPL_MAX_SIZE, size);
    scene->width = scene->height = size;
    builder.scale = size / DPL_SCENE_BASE;
    builder.random = dpl_random_start(seed, hash_of(family) + (uint64_t)index);
    return builder;
}

bool dpl_build_finish(dpl_scene_builder *builder) {
    if (!builder->good)
        dpl_scene_free(builder->scene);
    return builder->good;
}

double dpl_build_draw(dpl_scene_builder *builder, double low, double high) {
    return dpl_random_between(&builder->random, low, high);
}

static void add(dpl_scene_builder *builder, const dpl_shape *shape) {
    if (builder->good)
        builder->good = dpl_scene_add_shape(builder->scene, shape, builder->error);
}

static dpl_shape shape_of(dpl_shape_kind kind, dpl_material material) {
    dpl_shape shape = dpl_shape_default(kind);
    shape.material = material;
    return shape;
}

void dpl_build_sky_ring(dpl_scene_builder *builder, const double (*rgb)[3], int32_t count) {
    dpl_scene *scene = builder->scene;
    if (!builder->good)
        return;
    if (!(scene->sky_ring = malloc((size_t)count * sizeof *rgb))) {
        builder->good = dpl_error_set(builder->error, "out of memory");
        return;
    }
    memcpy(scene->sky_ring, rgb, (size_t)count * sizeof *rgb);
    scene->sky_sectors = count;
}

void dpl_build_disc(dpl_scene_builder *builder, double x, double y, double radius, dpl_material material) {
    dpl_shape shape = shape_of(DPL_SHAPE_DISC, material);
    shape.disc = (dpl_disc){{x * builder->scale, y * builder->scale}, radius * builder->scale};
    add(builder, &shape);
}

void dpl_build_box(dpl_scene_builder *builder, double x, double y, double half_width, double half_height,
                   double angle, dpl_material material) {
    dpl_shape shape = shape_of(DPL_SHAPE_BOX, material);
    shape.box = (dpl_box){{x * builder->scale, y * builder->scale},
                          {half_width * builder->scale, half_height * builder->scale},
                          angle};
    add(builder, &shape);
}

void dpl_build_rectangle(dpl_scene_builder *builder, double left, double top, double right, double bottom,
                         dpl_material material) {
    dpl_build_box(builder, (left + right) / 2, (top + bottom) / 2, (right - left) / 2, (bottom - top) / 2, 0,
                  material);
}

void dpl_build_segment(dpl_scene_builder *builder, double x0, double y0, double x1, double y1, double width,
                       dpl_material material) {
    dpl_shape shape = shape_of(DPL_SHAPE_SEGMENT, material);
    shape.segment = (dpl_segment){{x0 * builder->scale, y0 * builder->scale},
                                  {x1 * builder->scale, y1 * builder->scale},
                                  width * builder->scale};
    add(builder, &shape);
}

void dpl_build_polygon(dpl_scene_builder *builder, const double (*points)[2], int32_t count,
                       dpl_material material) {
    double scaled[16][2];
    int32_t used = count < 16 ? count : 16;
    for (int32_t i = 0; i < used; i++) {
        scaled[i][0] = points[i][0] * builder->scale;
        scaled[i][1] = points[i][1] * builder->scale;
    }
    dpl_shape shape = shape_of(DPL_SHAPE_POLYGON, material);
    shape.polygon = (dpl_polygon){(const double(*)[2])scaled, used};
    add(builder, &shape);
}

void dpl_build_light(dpl_scene_builder *builder, double x, double y, double radius) {
    if (!builder->good)
        return;
    dpl_scene *scene = builder->scene;
    scene->lights = calloc(1, sizeof *scene->lights);
    if (!scene->lights) {
        builder->good = dpl_error_set(builder->error, "out of memory");
        return;
    }
    scene->lights[0] =
        (dpl_scene_light){{x * builder->scale, y * builder->scale}, radius * builder->scale, {1, 1, 1}, 4};
    scene->light_count = 1;
}

dpl_material dpl_build_wall(void) {
    return dpl_material_default();
}

dpl_material dpl_build_lamp(double red, double green, double blue) {
    dpl_material material = dpl_material_default();
    material.emission[0] = (float)red;
    material.emission[1] = (float)green;
    material.emission[2] = (float)blue;
    return material;
}

dpl_material dpl_build_random_lamp(dpl_scene_builder *builder, double least, double most) {
    double rgb[3];
    double hue = dpl_build_draw(builder, 0, 1), saturation = dpl_build_draw(builder, 0.2, 1);
    dpl_colour_from_hsl(hue, saturation, 0.6, rgb);
    double intensity = dpl_build_draw(builder, least, most);
    return dpl_build_lamp(rgb[0] * intensity, rgb[1] * intensity, rgb[2] * intensity);
}

dpl_material dpl_build_medium(const dpl_scene_builder *builder, double red, double green, double blue) {
    dpl_material material = dpl_material_default();
    material.extinction[0] = (float)(red / builder->scale);
    material.extinction[1] = (float)(green / builder->scale);
    material.extinction[2] = (float)(blue / builder->scale);
    return material;
}

void dpl_build_turned_box(dpl_scene_builder *builder, double x, double y, double least, double most) {
    double half_width = dpl_build_draw(builder, least, most);
    double half_height = dpl_build_draw(builder, least, most);
    double angle = dpl_build_draw(builder, 0, 3.1);
    dpl_build_box(builder, x, y, half_width, half_height, angle, dpl_build_wall());
}

void dpl_build_lit_disc(dpl_scene_builder *builder, double x, double y, double radius, double least,
                        double most) {
    dpl_build_disc(builder, x, y, radius, dpl_build_random_lamp(builder, least, most));
}

/* One channel of the colour wheel: a trapezoid over the hue (CSS Color 3, section 4.2.4). */
static double hue_channel(double low, double high, double hue) {
    hue = hue < 0 ? hue + 1 : hue >= 1 ? hue - 1 : hue;
    if (hue * 6 < 1)
        return low + (high - low) * hue * 6;
    if (hue * 2 < 1)
        return high;
    if (hue * 3 < 2)
        return low + (high - low) * (2.0 / 3 - hue) * 6;
    return low;
}

void dpl_colour_from_hsl(double hue, double saturation, double lightness, double rgb[3]) {
    double high =
        lightness <= 0.5 ? lightness * (saturation + 1) : lightness + saturation - lightness * saturation;
    double low = lightness * 2 - high;
    rgb[0] = hue_channel(low, high, hue + 1.0 / 3);
    rgb[1] = hue_channel(low, high, hue);
    rgb[2] = hue_channel(low, high, hue - 1.0 / 3);
}
