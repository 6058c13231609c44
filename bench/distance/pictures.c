/* Walls by chance, in blocks, from a scene family, and along a slope. Called by main.c through the table. */
#include "pictures.h"

#include "../../scenes/families.h"

#include <stdlib.h>

static bool draw_noise(int32_t size, uint8_t *opacity, uint32_t every) {
    uint32_t state = 1;
    for (int32_t i = 0; i < size * size; i++) {
        state = state * 1664525u + 1013904223u;
        opacity[i] = (uint64_t)state * every >> 32 == 0 ? 255 : 0;
    }
    return true;
}

static bool draw_dense_noise(int32_t size, uint8_t *opacity, dpl_error *error) {
    (void)error;
    return draw_noise(size, opacity, 8);
}

static bool draw_thin_noise(int32_t size, uint8_t *opacity, dpl_error *error) {
    (void)error;
    return draw_noise(size, opacity, 1000);
}

static bool draw_blocks(int32_t size, uint8_t *opacity, dpl_error *error) {
    (void)error;
    for (int32_t i = 0; i < size * size; i++) {
        int32_t x = i % size, y = i / size;
        opacity[i] = (x / 37 + y / 29) % 5 == 0 ? 255 : 0;
    }
    return true;
}

/* The wall's pixels are as far along a row as along a column: the dearest there is for a search along rows.
 */
static bool draw_slope(int32_t size, uint8_t *opacity, dpl_error *error) {
    (void)error;
    for (int32_t i = 0; i < size * size; i++)
        opacity[i] = abs(i % size - i / size) < 2 ? 255 : 0;
    return true;
}

/* The scene's lamps are opaque too. */
static bool draw_arc(int32_t size, uint8_t *opacity, dpl_error *error) {
    dpl_scene scene = {0};
    dpl_context *context = NULL;
    dpl_field *field = NULL;
    dpl_status status = dpl_context_create(NULL, &context);
    bool good = status == DPL_OK || dpl_error_set(error, "%s", dpl_status_text(status));
    good = good && dpl_scene_family_find("arc")->make(1, 5, size, &scene, error) &&
           dpl_scene_build_field(&scene, context, false, &field, error);
    if (good)
        good = dpl_field_read_opaque(field, opacity, 0) == DPL_OK || dpl_error_set(error, "no field");
    for (int32_t i = 0; i < size * size && good; i++)
        opacity[i] = opacity[i] ? 255 : 0;
    dpl_field_destroy(field);
    dpl_context_destroy(context);
    dpl_scene_free(&scene);
    return good;
}

const dpl_bench_walls *dpl_bench_walls_all(int32_t *count) {
    static const dpl_bench_walls walls[] = {
        {"noise", "every eighth pixel by chance", draw_dense_noise},
        {"blocks", "a fifth of the picture, in blocks of 37 x 29 px", draw_blocks},
        {"arc", "scene 5 of family arc", draw_arc},
        {"thin", "every thousandth pixel by chance", draw_thin_noise},
        {"slope", "one wall along the diagonal", draw_slope},
    };
    *count = sizeof walls / sizeof walls[0];
    return walls;
}
