/* Fields from the scene family and from chance. Called by bench_speed and bench_gate. */
#include "world.h"

#include "../../scenes/families.h"

#include <stdlib.h>

typedef struct row {
    const char *name;
    const char *about;
    int32_t scene; /* of the family `arc`, or -1: noise */
    float opacity; /* of what is between the walls of noise */
} row;

static const row rows[DPL_BENCH_WORLDS] = {
    [DPL_BENCH_FEW] = {"arc-05", "scene 5 of family arc", 5, 0},
    [DPL_BENCH_MANY] = {"arc-49", "scene 49 of family arc: 50 lights, 8 occluders", 49, 0},
    [DPL_BENCH_NOISE] = {"noise", "every eighth pixel a wall or a lamp by chance: no empty blocks", -1, 0},
    [DPL_BENCH_MIST] = {"mist", "noise in a medium that fills the picture", -1, 0.01f},
};

const char *dpl_bench_world_name(dpl_bench_world world) {
    return rows[world].name;
}

const char *dpl_bench_world_about(dpl_bench_world world) {
    return rows[world].about;
}

static bool make_scene(int32_t index, int32_t size, dpl_context *context, dpl_field **field,
                       dpl_error *error) {
    dpl_scene scene = {0};
    bool good = dpl_scene_family_find("arc")->make(1, index, size, &scene, error) &&
                dpl_scene_build_field(&scene, context, false, field, error);
    dpl_scene_free(&scene);
    return good;
}

/* Of eight pixels one is opaque, and one of sixteen of those a lamp. */
static void fill(float *emission, float *opacity, size_t count, float between) {
    uint32_t state = 1;
    for (size_t i = 0; i < count; i++) {
        state = state * 1664525u + 1013904223u;
        bool wall = state >> 29 == 0, lamp = wall && (state >> 25 & 15) == 0;
        for (size_t c = 0; c < 3; c++)
            emission[3 * i + c] = lamp ? 1.0f : 0.0f;
        opacity[i] = wall ? 1.0f : between;
    }
}

static dpl_status draw(dpl_field *field, const float *emission, const float *opacity, int32_t size) {
    dpl_layer layer = dpl_layer_default();
    layer.emission = (dpl_pixels){.data = emission, .width = size, .height = size, .channels = 3};
    layer.extinction = (dpl_pixels){.data = opacity, .width = size, .height = size, .channels = 1};
    return dpl_field_draw_layer(field, &layer);
}

static bool make_noise(float between, int32_t size, dpl_context *context, dpl_field **field,
                       dpl_error *error) {
    size_t count = (size_t)size * (size_t)size;
    float *emission = malloc(count * sizeof(float[3])), *opacity = malloc(count * sizeof *opacity);
    dpl_field_desc desc = dpl_field_desc_default();
    desc.width = desc.height = size;
    dpl_status status = emission && opacity ? DPL_OK : DPL_ERROR_MEMORY;
    if (status == DPL_OK) {
        fill(emission, opacity, count, between);
        status = dpl_field_create(context, &desc, field);
    }
    if (status == DPL_OK)
        status = draw(*field, emission, opacity, size);
    free(emission);
    free(opacity);
    return status == DPL_OK || dpl_error_set(error, "%s", dpl_status_text(status));
}

bool dpl_bench_world_make(dpl_bench_world world, int32_t size, dpl_context *context, dpl_field **field,
                          dpl_error *error) {
    const row *r = &rows[world];
    return r->scene < 0 ? make_noise(r->opacity, size, context, field, error)
                        : make_scene(r->scene, size, context, field, error);
}
