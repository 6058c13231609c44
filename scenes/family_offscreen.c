/* The family "offscreen": what lights the picture stands outside it, in the margin, among walls that cast
 * their shadows in; and a sky that glows on one side. Called through the table in families.c. */
#include "family_list.h"
#include "scene_builder.h"

/* Width of the margin, where the format allows that much. */
#define MARGIN 128.0

#define SKY_SECTORS 12

/* A point of the margin, at least `apart` from its edges: turned from the strip above the picture to one of
 * the four sides. */
static void draw_outside(dpl_scene_builder *b, double apart, double point[2]) {
    double along = dpl_build_draw(b, 0, DPL_SCENE_BASE), out = dpl_build_draw(b, -MARGIN + apart, -apart);
    int32_t side = dpl_random_below(&b->random, 4);
    double far = side & 1 ? DPL_SCENE_BASE - out : out;
    point[0] = side & 2 ? far : along;
    point[1] = side & 2 ? along : far;
}

static void add_lamp(dpl_scene_builder *b) {
    double at[2];
    draw_outside(b, 24, at);
    double radius = dpl_build_draw(b, 6, 20);
    dpl_build_lit_disc(b, at[0], at[1], radius, 1, 3);
}

static void add_wall_outside(dpl_scene_builder *b) {
    double from[2];
    draw_outside(b, 4, from);
    double dx = dpl_build_draw(b, -60, 60), dy = dpl_build_draw(b, -60, 60);
    dpl_build_segment(b, from[0], from[1], from[0] + dx, from[1] + dy, 4, dpl_build_wall());
}

static void add_sky(dpl_scene_builder *b) {
    double rgb[SKY_SECTORS][3], strength = dpl_build_draw(b, 0.01, 0.08);
    int32_t west = dpl_random_below(&b->random, SKY_SECTORS);
    for (int32_t k = 0; k < SKY_SECTORS; k++) {
        int32_t apart = (k - west + SKY_SECTORS) % SKY_SECTORS;
        double glow = (apart < SKY_SECTORS / 2 ? apart : SKY_SECTORS - apart) / (SKY_SECTORS / 2.0);
        rgb[k][0] = strength * glow;
        rgb[k][1] = strength * (0.1 + 0.5 * glow);
        rgb[k][2] = strength * (0.3 + 0.2 * glow);
    }
    dpl_build_sky_ring(b, (const double(*)[3])rgb, SKY_SECTORS);
}

DPL_FAMILY(offscreen) {
    dpl_scene_builder b = dpl_build_start("offscreen", seed, index, size, scene, error);
    if (!b.good) /* the margin is counted in whole pixels */
        return dpl_build_finish(&b);
    int32_t room = (DPL_MAX_SIZE - size) / 2, margin = (int32_t)(MARGIN * b.scale);
    scene->margin = margin < room ? margin : room;
    int32_t lamps = 2 + dpl_random_below(&b.random, 5), walls = 2 + dpl_random_below(&b.random, 8);
    int32_t boxes = 2 + dpl_random_below(&b.random, 6);
    add_sky(&b);
    for (int32_t i = 0; i < walls; i++)
        add_wall_outside(&b);
    for (int32_t i = 0; i < lamps; i++)
        add_lamp(&b);
    for (int32_t i = 0; i < boxes; i++) {
        double x = dpl_build_draw(&b, 40, 472), y = dpl_build_draw(&b, 40, 472);
        dpl_build_turned_box(&b, x, y, 6, 45);
    }
    return dpl_build_finish(&b);
}
