/* The family "shadows": one disc light among walls, for judging shadow methods. Scenes 0 .. 7 are the set
 * that figures are quoted over: four layouts, each with a light of radius 6 and of radius 18. Scenes 8 .. 11
 * are unkind: hair-thin walls, many layers, blockers that touch, a light as large as a room. Called through
 * the table in families.c. */
#include "family_list.h"
#include "scene_builder.h"

#include <string.h>

/* Boxes and discs of all sizes, none on the light. */
static void add_mixed(dpl_scene_builder *b) {
    for (int32_t i = 0; i < 22; i++) {
        double x = dpl_build_draw(b, 20, 492), y = dpl_build_draw(b, 20, 492), away_x = x - 250,
               away_y = y - 262;
        double size = dpl_build_draw(b, 4, 26), angle = dpl_build_draw(b, 0, 3.1);
        if (away_x * away_x + away_y * away_y < 60 * 60)
            continue;
        if (i % 2)
            dpl_build_disc(b, x, y, 0.8 * size, dpl_build_wall());
        else
            dpl_build_box(b, x, y, size, 0.4 * size, angle, dpl_build_wall());
    }
    dpl_build_light(b, 250, 262, 1);
}

/* 9 x 9 discs, much thinner than the light is wide. */
static void add_pillars(dpl_scene_builder *b) {
    for (int32_t i = 0; i < 81; i++) {
        double x = 120 + 34 * (i % 9) + dpl_build_draw(b, -5, 5),
               y = 140 + 34 * (i / 9) + dpl_build_draw(b, -5, 5);
        dpl_build_disc(b, x, y, dpl_build_draw(b, 1.5, 3), dpl_build_wall());
    }
    dpl_build_light(b, 60, 60, 1);
}

/* A fence of slats, and behind it three layers of blockers that fuse or do not. */
static void add_slats(dpl_scene_builder *b) {
    for (int32_t i = 0; i < 11; i++)
        dpl_build_rectangle(b, 120 + 26 * i, 120, 133 + 26 * i, 128, dpl_build_wall());
    for (int32_t layer = 0; layer < 3; layer++)
        for (int32_t i = 0; i < 6; i++) {
            double x = 40 + 80 * i + dpl_build_draw(b, -25, 25),
                   y = 200 + 85 * layer + dpl_build_draw(b, -15, 15);
            dpl_build_turned_box(b, x, y, 5, 16);
        }
    dpl_build_light(b, 262, 56, 1);
}

/* A room with furniture against its walls and against each other. */
static void add_room(dpl_scene_builder *b) {
    static const double boxes[][4] = {
        {20, 20, 492, 28},    {20, 484, 492, 492},  {20, 28, 28, 484},    {484, 28, 492, 484},
        {250, 28, 258, 170},  {250, 230, 258, 484}, {28, 120, 60, 180},   {60, 150, 90, 180},
        {150, 440, 210, 484}, {210, 465, 250, 484}, {300, 300, 340, 340}, {340, 320, 360, 330},
        {400, 28, 440, 60},   {258, 400, 300, 410}, {430, 200, 484, 210}, {110, 250, 140, 256},
    };
    for (size_t i = 0; i < sizeof boxes / sizeof boxes[0]; i++)
        dpl_build_rectangle(b, boxes[i][0], boxes[i][1], boxes[i][2], boxes[i][3], dpl_build_wall());
    for (int32_t i = 0; i < 10; i++) {
        double x = dpl_build_draw(b, 60, 230), y = dpl_build_draw(b, 280, 420);
        dpl_build_disc(b, x, y, dpl_build_draw(b, 2, 9), dpl_build_wall());
    }
    dpl_build_light(b, 180, 200, 1);
}

/* Walls a pixel thin, at any size. */
static void add_thin(dpl_scene_builder *b) {
    for (int32_t i = 0; i < 40; i++) {
        double x = dpl_build_draw(b, 10, 500), y = dpl_build_draw(b, 10, 500);
        double to_x = x + dpl_build_draw(b, -40, 40), to_y = y + dpl_build_draw(b, -40, 40);
        dpl_build_segment(b, x, y, to_x, to_y, 1.2 / b->scale, dpl_build_wall());
    }
    dpl_build_light(b, 256, 240, 10);
}

static void add_layers(dpl_scene_builder *b) {
    for (int32_t layer = 0; layer < 12; layer++)
        for (int32_t i = 0; i < 14; i++) {
            double x = 36 * i + dpl_build_draw(b, 0, 22), y = 110 + 32 * layer;
            dpl_build_rectangle(b, x, y, x + dpl_build_draw(b, 4, 18), y + 3, dpl_build_wall());
        }
    dpl_build_light(b, 256, 50, 14);
}

/* Discs in a heap, and a light that touches one of them and a wall. */
static void add_contact(dpl_scene_builder *b) {
    for (int32_t row = 0; row < 6; row++)
        for (int32_t i = 0; i + row < 8; i++)
            dpl_build_disc(b, 200 + 24 * i + 12 * row, 400 - 20.8 * row, 12, dpl_build_wall());
    dpl_build_rectangle(b, 0, 412, 512, 424, dpl_build_wall());
    dpl_build_rectangle(b, 90, 200, 100, 412, dpl_build_wall());
    for (int32_t i = 0; i < 12; i++) {
        double x = dpl_build_draw(b, 110, 480), y = dpl_build_draw(b, 20, 180);
        dpl_build_turned_box(b, x, y, 2, 10);
    }
    dpl_build_light(b, 112, 250, 12);
}

static void add_huge(dpl_scene_builder *b) {
    for (int32_t i = 0; i < 30; i++) {
        double x = dpl_build_draw(b, 10, 500), y = dpl_build_draw(b, 10, 500);
        dpl_build_turned_box(b, x, y, 3, 20);
    }
    dpl_build_light(b, 200, 280, 110);
}

DPL_FAMILY(shadows) {
    static void (*const layouts[])(dpl_scene_builder *) = {add_mixed, add_pillars, add_slats,   add_room,
                                                           add_thin,  add_layers,  add_contact, add_huge};
    if (index < 0 || index > 11) {
        memset(scene, 0, sizeof *scene);
        return dpl_error_set(error, "shadows: there are scenes 0 to 11, but no %d", index);
    }
    /* The two radii of a layout share their random numbers. */
    int32_t layout = index < 8 ? index / 2 : index - 4;
    dpl_scene_builder b = dpl_build_start("shadows", seed, layout, size, scene, error);
    layouts[layout](&b);
    if (b.good && index < 8)
        scene->lights[0].radius = (index % 2 ? 18 : 6) * b.scale;
    return dpl_build_finish(&b);
}
