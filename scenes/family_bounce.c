/* The family "bounce": a closed room of painted walls, with few lamps, much of which only reflected light
 * reaches. Called through the table in families.c. */
#include "family_list.h"
#include "scene_builder.h"

/* Thickness of the room's walls. */
#define WALL 16.0

static dpl_material paint(double red, double green, double blue) {
    dpl_material material = dpl_material_default();
    material.albedo[0] = (float)red;
    material.albedo[1] = (float)green;
    material.albedo[2] = (float)blue;
    return material;
}

/* Any hue, from nearly grey to strong; the brightest channel reflects `albedo`. */
static dpl_material draw_paint(dpl_scene_builder *b, double least, double most) {
    double rgb[3], hue = dpl_build_draw(b, 0, 1), strength = dpl_build_draw(b, 0, 0.8);
    double albedo = dpl_build_draw(b, least, most);
    dpl_colour_from_hsl(hue, 1, 0.5, rgb);
    for (int k = 0; k < 3; k++)
        rgb[k] = albedo * (1 - strength * (1 - rgb[k]));
    return paint(rgb[0], rgb[1], rgb[2]);
}

/* White above and below, a colour on either side. */
static void add_room(dpl_scene_builder *b) {
    const double size = DPL_SCENE_BASE;
    dpl_build_rectangle(b, 0, 0, size, WALL, paint(0.8, 0.8, 0.8));
    dpl_build_rectangle(b, 0, size - WALL, size, size, paint(0.8, 0.8, 0.8));
    dpl_build_rectangle(b, 0, 0, WALL, size, draw_paint(b, 0.6, 0.9));
    dpl_build_rectangle(b, size - WALL, 0, size, size, draw_paint(b, 0.6, 0.9));
}

/* A painted wall from one side into the room, around `y`: light gets behind it by reflection alone. */
static void add_screen(dpl_scene_builder *b, double around) {
    double y = dpl_build_draw(b, around - 50, around + 50), reach = dpl_build_draw(b, 140, 330);
    bool right = dpl_random_below(&b->random, 2) == 1;
    double from = right ? DPL_SCENE_BASE - WALL - reach : WALL;
    dpl_build_rectangle(b, from, y - 4, from + reach, y + 4, draw_paint(b, 0.5, 0.9));
}

static void add_occluder(dpl_scene_builder *b) {
    dpl_material material = draw_paint(b, 0.2, 0.9);
    double x = dpl_build_draw(b, 60, 452), y = dpl_build_draw(b, 60, 452);
    if (dpl_random_below(&b->random, 3) == 0) {
        dpl_build_disc(b, x, y, dpl_build_draw(b, 8, 40), material);
        return;
    }
    double half_width = dpl_build_draw(b, 6, 45), half_height = dpl_build_draw(b, 6, 45);
    dpl_build_box(b, x, y, half_width, half_height, dpl_build_draw(b, 0, 3.1), material);
}

DPL_FAMILY(bounce) {
    dpl_scene_builder b = dpl_build_start("bounce", seed, index, size, scene, error);
    int32_t screens = 1 + dpl_random_below(&b.random, 2), occluders = 3 + dpl_random_below(&b.random, 6);
    int32_t lamps = 1 + dpl_random_below(&b.random, 3);
    add_room(&b);
    for (int32_t i = 0; i < screens; i++)
        add_screen(&b, (i + 1) * DPL_SCENE_BASE / (screens + 1));
    for (int32_t i = 0; i < occluders; i++)
        add_occluder(&b);
    for (int32_t i = 0; i < lamps; i++) {
        double x = dpl_build_draw(&b, 40, 472), y = dpl_build_draw(&b, 40, 472);
        double warmth = dpl_build_draw(&b, 0.5, 1), intensity = dpl_build_draw(&b, 1, 3);
        dpl_material lamp = dpl_build_lamp(intensity, intensity * (0.6 + 0.4 * warmth), intensity * warmth);
        dpl_build_disc(&b, x, y, dpl_build_draw(&b, 6, 14), lamp);
    }
    return dpl_build_finish(&b);
}
