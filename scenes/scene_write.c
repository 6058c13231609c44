/* Writes scenes as JSON that reads back to the same scene: one shape, image or light per line. */
#include "../image/file.h"
#include "number_text.h"
#include "scene.h"

#include <jansson.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

static void put_numbers(FILE *out, const double *numbers, int count) {
    for (int i = 0; i < count; i++)
        fprintf(out, "%s%s", i > 0 ? ", " : "[", dpl_number_text_double(numbers[i]).text);
    fputc(']', out);
}

static bool is_zero(const float rgb[3]) {
    return fpclassify(rgb[0]) == FP_ZERO && fpclassify(rgb[1]) == FP_ZERO && fpclassify(rgb[2]) == FP_ZERO;
}

static void put_rgb(FILE *out, const char *key, const float rgb[3]) {
    fprintf(out, ", \"%s\": [%s, %s, %s]", key, dpl_number_text_float(rgb[0]).text,
            dpl_number_text_float(rgb[1]).text, dpl_number_text_float(rgb[2]).text);
}

static void put_disc(FILE *out, const dpl_shape *shape) {
    fputs("\"disc\": { \"center\": ", out);
    put_numbers(out, shape->disc.center, 2);
    fprintf(out, ", \"radius\": %s }", dpl_number_text_double(shape->disc.radius).text);
}

static void put_box(FILE *out, const dpl_shape *shape) {
    fputs("\"box\": { \"center\": ", out);
    put_numbers(out, shape->box.center, 2);
    fputs(", \"half\": ", out);
    put_numbers(out, shape->box.half, 2);
    fprintf(out, ", \"angle\": %s }", dpl_number_text_double(shape->box.angle).text);
}

static void put_polygon(FILE *out, const dpl_shape *shape) {
    fputs("\"polygon\": { \"points\": [", out);
    for (int32_t i = 0; i < shape->polygon.count; i++) {
        fputs(i > 0 ? ", " : "", out);
        put_numbers(out, shape->polygon.points[i], 2);
    }
    fputs("] }", out);
}

static void put_segment(FILE *out, const dpl_shape *shape) {
    fputs("\"segment\": { \"from\": ", out);
    put_numbers(out, shape->segment.from, 2);
    fputs(", \"to\": ", out);
    put_numbers(out, shape->segment.to, 2);
    fprintf(out, ", \"width\": %s }", dpl_number_text_double(shape->segment.width).text);
}

/* By dpl_shape_kind. */
static void (*const put_kind[])(FILE *out, const dpl_shape *shape) = {put_disc, put_box, put_polygon,
                                                                      put_segment};

static void put_shape(FILE *out, const dpl_shape *shape) {
    const dpl_material *material = &shape->material;
    fputs("{ ", out);
    put_kind[shape->kind](out, shape);
    if (!is_zero(material->emission))
        put_rgb(out, "emission", material->emission);
    if (isfinite(material->extinction[0]))
        put_rgb(out, "extinction", material->extinction);
    if (!is_zero(material->albedo))
        put_rgb(out, "albedo", material->albedo);
    fputs(" }", out);
}

/* A picture's name as a JSON string. */
static bool put_name(FILE *out, const char *key, const char *name, dpl_error *error) {
    if (!name)
        return true;
    json_t *string = json_string(name);
    char *text = string ? json_dumps(string, JSON_ENCODE_ANY) : NULL;
    json_decref(string);
    if (!text)
        return dpl_error_set(error, "%s: the picture's name is not UTF-8, or out of memory", name);
    fprintf(out, "\"%s\": %s, ", key, text);
    free(text);
    return true;
}

static bool put_image(FILE *out, const dpl_scene_image *image, dpl_error *error) {
    fputs("{ ", out);
    if (!put_name(out, "emission", image->emission, error) ||
        !put_name(out, "extinction", image->extinction, error) ||
        !put_name(out, "albedo", image->albedo, error))
        return false;
    fprintf(out, "\"at\": [%d, %d], \"intensity\": %s }", image->at[0], image->at[1],
            dpl_number_text_double(image->intensity).text);
    return true;
}

static void put_light(FILE *out, const dpl_scene_light *light) {
    fputs("{ \"position\": ", out);
    put_numbers(out, light->position, 2);
    fprintf(out, ", \"radius\": %s, \"color\": ", dpl_number_text_double(light->radius).text);
    put_numbers(out, light->color, 3);
    fprintf(out, ", \"intensity\": %s }", dpl_number_text_double(light->intensity).text);
}

static void put_sky(FILE *out, const dpl_scene *scene) {
    fputs("  \"sky\": ", out);
    if (!scene->sky_ring)
        put_numbers(out, scene->sky, 3);
    for (int32_t k = 0; k < scene->sky_sectors; k++) {
        fputs(k > 0 ? ",\n    " : "[\n    ", out);
        put_numbers(out, scene->sky_ring[k], 3);
    }
    fputs(scene->sky_ring ? "\n  ]" : "", out);
}

/* Begins entry `index` of a list: the list's key before the first one. */
static void put_separator(FILE *out, const char *key, int32_t index) {
    if (index == 0)
        fprintf(out, ",\n  \"%s\": [\n    ", key);
    else
        fputs(",\n    ", out);
}

static void put_list_end(FILE *out, int32_t count) {
    if (count > 0)
        fputs("\n  ]", out);
}

static bool put_scene(FILE *out, const dpl_scene *scene, dpl_error *error) {
    fprintf(out, "{\n  \"dapple\": 1,\n  \"size\": [%d, %d],\n", scene->width, scene->height);
    if (scene->margin > 0)
        fprintf(out, "  \"margin\": %d,\n", scene->margin);
    put_sky(out, scene);
    for (int32_t i = 0; i < scene->image_count; i++) {
        put_separator(out, "images", i);
        if (!put_image(out, &scene->images[i], error))
            return false;
    }
    put_list_end(out, scene->image_count);
    for (int32_t i = 0; i < scene->shape_count; i++) {
        put_separator(out, "shapes", i);
        put_shape(out, &scene->shapes[i]);
    }
    put_list_end(out, scene->shape_count);
    for (int32_t i = 0; i < scene->light_count; i++) {
        put_separator(out, "lights", i);
        put_light(out, &scene->lights[i]);
    }
    put_list_end(out, scene->light_count);
    fputs("\n}\n", out);
    return true;
}

/* Can the format say it? It has no word for a shape that is opaque to one colour only, nor for a picture
 * without a name. */
static bool can_write(const char *path, const dpl_scene *scene, dpl_error *error) {
    for (int32_t i = 0; i < scene->shape_count; i++) {
        const float *extinction = scene->shapes[i].material.extinction;
        int opaque = isinf(extinction[0]) != 0;
        if ((isinf(extinction[1]) != 0) != opaque || (isinf(extinction[2]) != 0) != opaque)
            return dpl_error_set(
                error, "%s: shapes[%d]: opaque to some colours only, which cannot be written", path, i);
    }
    for (int32_t i = 0; i < scene->image_count; i++) {
        const dpl_scene_image *image = &scene->images[i];
        if ((image->emission_picture.data && !image->emission) ||
            (image->extinction_picture.data && !image->extinction) ||
            (image->albedo_picture.data && !image->albedo))
            return dpl_error_set(error, "%s: images[%d]: a picture without a name cannot be written", path,
                                 i);
    }
    return true;
}

bool dpl_scene_write(const char *path, const dpl_scene *scene, dpl_error *error) {
    dpl_file_writer writer;
    if (!can_write(path, scene, error) || !dpl_file_writer_open(&writer, path, error))
        return false;
    bool good = put_scene(writer.stream, scene, error);
    return dpl_file_writer_close(&writer, good, error);
}
