/* Scenes by family, and those with textured lamps. Called by main.c. */
#include "subject.h"

#include "../../scenes/random.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const dpl_bench_subject textured = {"textured", 10};

bool dpl_bench_subject_find(const char *name, dpl_bench_subject *subject) {
    const dpl_scene_family *family = dpl_scene_family_find(name);
    *subject = family ? (dpl_bench_subject){family->name, family->count} : textured;
    return strcmp(subject->name, name) == 0;
}

/* ---- textured lamps ------------------------------------------------------------------------------- */

/* A disc or box with waves of light on it, or a black one. */
static void paint_patch(dpl_random *random, int32_t size, bool shines, float *emission, float *opacity) {
    double x = dpl_random_between(random, 0, size), y = dpl_random_between(random, 0, size);
    double half_x = size * dpl_random_between(random, 0.01, 0.1),
           half_y = size * dpl_random_between(random, 0.01, 0.1);
    double wave = dpl_random_between(random, 3, 40), angle = dpl_random_between(random, 0, 3.1);
    double rgb[3];
    bool round = dpl_random_below(random, 2) == 0;
    for (int c = 0; c < 3; c++)
        rgb[c] = dpl_random_between(random, 0.2, 2.0);
    for (int32_t i = 0; i < size * size; i++) {
        double u = (i % size + 0.5 - x) / half_x, v = (i / size + 0.5 - y) / half_y;
        if (round ? u * u + v * v > 1 : fabs(u) > 1 || fabs(v) > 1)
            continue;
        double along = (i % size * cos(angle) + i / size * sin(angle)) * 6.2831853 / wave;
        for (int c = 0; c < 3; c++)
            emission[3 * i + c] = shines ? (float)(rgb[c] * (0.55 + 0.45 * sin(along + c))) : 0.0f;
        opacity[i] = 1.0f;
    }
}

static bool lay_textures(uint64_t seed, int32_t index, int32_t size, dpl_field *field) {
    size_t pixels = (size_t)size * (size_t)size;
    float *emission = calloc(4 * pixels, sizeof *emission);
    if (!emission)
        return false;
    dpl_random random = dpl_random_start(seed, 1000 + (uint64_t)index);
    int32_t patches = 6 + dpl_random_below(&random, 14);
    for (int32_t i = 0; i < patches; i++)
        paint_patch(&random, size, i % 2 == 0, emission, emission + 3 * pixels);
    dpl_layer layer = dpl_layer_default();
    layer.emission = (dpl_pixels){emission, DPL_FORMAT_F32, size, size, 3, 0};
    layer.extinction = (dpl_pixels){emission + 3 * pixels, DPL_FORMAT_F32, size, size, 1, 0};
    bool good = dpl_field_draw_layer(field, &layer) == DPL_OK;
    free(emission);
    return good;
}

static bool textured_field(uint64_t seed, int32_t index, int32_t size, dpl_context *context,
                           dpl_field **field, dpl_error *error) {
    dpl_field_desc desc = dpl_field_desc_default();
    desc.width = desc.height = size;
    if (dpl_field_create(context, &desc, field) == DPL_OK && lay_textures(seed, index, size, *field))
        return true;
    dpl_field_destroy(*field);
    return dpl_error_set(error, "textured: %s", dpl_context_message(context));
}

bool dpl_bench_subject_field(const dpl_bench_subject *subject, uint64_t seed, int32_t index, int32_t size,
                             dpl_context *context, dpl_field **field, dpl_error *error) {
    const dpl_scene_family *family = dpl_scene_family_find(subject->name);
    if (!family)
        return textured_field(seed, index, size, context, field, error);
    dpl_scene scene = {0};
    bool good = family->make(seed, index, size, &scene, error) &&
                dpl_scene_build_field(&scene, context, false, field, error);
    dpl_scene_free(&scene);
    return good;
}
