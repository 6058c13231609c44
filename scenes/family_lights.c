/* Families that differ in their lights and in the number of occluders: "tiny", "area" and "clutter". Called
 * through the table in families.c. */
#include "family_list.h"
#include "scene_builder.h"

/* Boxes turned any way, as many as asked for. */
static void add_boxes(dpl_scene_builder *b, int32_t count, double least, double most) {
    for (int32_t i = 0; i < count; i++) {
        double x = dpl_build_draw(b, 20, 492), y = dpl_build_draw(b, 20, 492);
        dpl_build_turned_box(b, x, y, least, most);
    }
}

/* Lights of 2x2 pixels at any size: an angle step too coarse misses them or makes them flicker. */
DPL_FAMILY(tiny) {
    dpl_scene_builder b = dpl_build_start("tiny", seed, index, size, scene, error);
    if (!b.good) /* whole pixels are counted in integers below */
        return dpl_build_finish(&b);
    int32_t boxes = 3 + dpl_random_below(&b.random, 10), lights = 2 + dpl_random_below(&b.random, 12);
    add_boxes(&b, boxes, 4, 40);
    b.scale = 1;
    for (int32_t i = 0; i < lights; i++) {
        int32_t x = 1 + dpl_random_below(&b.random, size), y = 1 + dpl_random_below(&b.random, size);
        dpl_build_rectangle(&b, x - 1, y - 1, x + 1, y + 1, dpl_build_random_lamp(&b, 5, 30));
    }
    return dpl_build_finish(&b);
}

static void add_area_light(dpl_scene_builder *b) {
    dpl_material lamp = dpl_build_random_lamp(b, 0.3, 1.2);
    double x = dpl_build_draw(b, 60, 452), y = dpl_build_draw(b, 60, 452), radius = dpl_build_draw(b, 30, 90);
    int32_t kind = dpl_random_below(&b->random, 3);
    if (kind == 0) {
        dpl_build_disc(b, x, y, radius, lamp);
    } else if (kind == 1) {
        double flat = dpl_build_draw(b, 4, 20), angle = dpl_build_draw(b, 0, 3.1);
        dpl_build_box(b, x, y, radius, flat, angle, lamp);
    } else {
        double triangle[3][2];
        for (int32_t k = 0; k < 3; k++) {
            triangle[k][0] = x + dpl_build_draw(b, -radius, radius);
            triangle[k][1] = y + dpl_build_draw(b, -radius, radius);
        }
        dpl_build_polygon(b, (const double(*)[2])triangle, 3, lamp);
    }
}

/* Lights as large as rooms: wide penumbrae, and almost nothing dark. */
DPL_FAMILY(area) {
    dpl_scene_builder b = dpl_build_start("area", seed, index, size, scene, error);
    int32_t lights = 1 + dpl_random_below(&b.random, 4), boxes = 4 + dpl_random_below(&b.random, 9);
    for (int32_t i = 0; i < lights; i++)
        add_area_light(&b);
    add_boxes(&b, boxes, 4, 30);
    return dpl_build_finish(&b);
}

static void add_crumb(dpl_scene_builder *b) {
    double x = dpl_build_draw(b, 0, 512), y = dpl_build_draw(b, 0, 512), radius = dpl_build_draw(b, 0.8, 6);
    int32_t kind = dpl_random_below(&b->random, 3);
    if (kind == 0) {
        dpl_build_disc(b, x, y, radius, dpl_build_wall());
    } else if (kind == 1) {
        double flat = dpl_build_draw(b, 0.5, 3), angle = dpl_build_draw(b, 0, 3.1);
        dpl_build_box(b, x, y, radius, flat, angle, dpl_build_wall());
    } else {
        double to_x = x + dpl_build_draw(b, -10, 10), to_y = y + dpl_build_draw(b, -10, 10);
        dpl_build_segment(b, x, y, to_x, to_y, 1.5, dpl_build_wall());
    }
}

/* Hundreds of small occluders: every ray is short, and no probe sees what its neighbour sees. */
DPL_FAMILY(clutter) {
    dpl_scene_builder b = dpl_build_start("clutter", seed, index, size, scene, error);
    int32_t crumbs = 200 + dpl_random_below(&b.random, 500), lights = 3 + dpl_random_below(&b.random, 8);
    for (int32_t i = 0; i < crumbs; i++)
        add_crumb(&b);
    for (int32_t i = 0; i < lights; i++) {
        double x = dpl_build_draw(&b, 20, 492), y = dpl_build_draw(&b, 20, 492);
        dpl_build_lit_disc(&b, x, y, dpl_build_draw(&b, 3, 14), 1, 5);
    }
    return dpl_build_finish(&b);
}
