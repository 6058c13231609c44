/* The scene "demo": a house cut open at night, made by hand to be looked at. All four kinds of shape, warm
 * and cold light, a lattice, stained glass and a bank of fog. Called through the table in families.c. */
#include "family_list.h"
#include "scene_builder.h"

/* A straight piece of wall, beam or cord between two points [base px]. */
typedef struct wall {
    double from[2];
    double to[2];
    double width;
} wall;

static const wall walls[] = {
    /* outer walls: left with a window upstairs and the house door, right with a stained window */
    {{152, 214}, {152, 236}, 7},
    {{152, 296}, {152, 388}, 7},
    {{438, 214}, {438, 352}, 7},
    {{438, 424}, {438, 456}, 7},
    /* ceiling of the upper floor with a hatch, floor between the floors with a stairwell */
    {{152, 214}, {206, 214}, 6},
    {{240, 214}, {438, 214}, 6},
    {{152, 330}, {348, 330}, 7},
    {{392, 330}, {438, 330}, 7},
    /* inner walls with doorways */
    {{300, 214}, {300, 268}, 5},
    {{286, 330}, {286, 396}, 5},
    /* roof, with a gap for the skylight */
    {{136, 222}, {295, 112}, 8},
    {{295, 112}, {352, 151}, 8},
    {{386, 174}, {454, 222}, 8},
    /* rafters */
    {{262, 138}, {262, 158}, 3},
    {{318, 130}, {318, 148}, 3},
    /* stairs, table, shelf */
    {{348, 330}, {330, 372}, 2.5},
    {{176, 420}, {226, 420}, 4},
    {{201, 422}, {201, 452}, 3},
    {{316, 292}, {352, 292}, 3},
    /* street lamp: bracket on the wall, and shade */
    {{152, 312}, {104, 312}, 2.5},
    {{100, 320}, {104, 313}, 3},
    {{104, 313}, {114, 319}, 3},
    /* fence in the fog */
    {{16, 458}, {16, 428}, 2},
    {{34, 457}, {34, 426}, 2},
    {{52, 456}, {52, 427}, 2},
    {{70, 456}, {70, 425}, 2},
    /* garden tree */
    {{496, 458}, {493, 330}, 5},
    {{494, 350}, {478, 318}, 3},
    {{494, 340}, {506, 312}, 3},
    /* cords of the hanging lamps */
    {{222, 330}, {222, 352}, 1.5},
    {{392, 214}, {392, 232}, 1.5},
};

/* Round things that block [base px]. */
static const double leaves[][3] = {{474, 312, 8}, {486, 300, 10}, {502, 304, 9}, {492, 284, 7},
                                   {476, 290, 5}, {507, 286, 5},  {466, 300, 4}};

/* A lamp: a disc and its radiance. */
typedef struct lamp {
    double at[2];
    double radius;
    double rgb[3];
} lamp;

static const lamp lamps[] = {
    {{70, 62}, 17, {0.42, 0.55, 0.85}}, /* moon */
    {{104, 320}, 4, {3.4, 1.7, 0.45}},  /* street lamp */
    {{222, 357}, 5, {2.6, 1.35, 0.45}}, /* over the table */
    {{392, 238}, 5, {2.2, 0.35, 1.5}},  /* upper right room */
    {{404, 388}, 5, {2.7, 2.0, 1.1}},   /* behind the stained window */
    {{278, 196}, 2, {3.4, 1.5, 0.3}},   /* candle under the roof */
    {{334, 288}, 3, {0.25, 1.6, 1.2}},  /* a jar of something on the shelf */
};

/* Stained glass: what each pane takes from red, green and blue, per base pixel. */
typedef struct pane {
    double corners[4]; /* left, top, right, bottom */
    double rgb[3];
} pane;

static const pane panes[] = {
    {{435, 352, 441, 376}, {0.02, 0.5, 0.6}},  /* red */
    {{435, 376, 441, 400}, {0.02, 0.12, 0.7}}, /* amber */
    {{435, 400, 441, 424}, {0.6, 0.2, 0.01}},  /* blue */
    {{149, 236, 155, 296}, {0.1, 0.05, 0.02}}, /* plain window, faintly blue */
};

static void add_ground(dpl_scene_builder *b) {
    static const double hill[][2] = {{0, 462},   {40, 456},  {150, 455}, {440, 455},
                                     {512, 458}, {512, 512}, {0, 512}};
    static const double chimney[][2] = {{388, 132}, {408, 132}, {408, 192}, {388, 178}};
    static const double skylight[][2] = {{350, 146}, {388, 172}, {385, 178}, {347, 152}};
    dpl_material earth = dpl_build_wall();
    earth.albedo[0] = 0.30f;
    earth.albedo[1] = 0.24f;
    earth.albedo[2] = 0.18f;
    dpl_build_polygon(b, hill, 7, earth);
    dpl_build_polygon(b, chimney, 4, dpl_build_wall());
    dpl_build_polygon(b, skylight, 4, dpl_build_medium(b, 0.25, 0.06, 0.12));
}

/* Thinner towards the top; lies over the street, so that the lamp's cone and the moon's light fade in it. */
static void add_fog(dpl_scene_builder *b) {
    static const double banks[3][2] = {{382, 0.0035}, {408, 0.006}, {432, 0.010}};
    for (int i = 0; i < 3; i++) {
        double top = banks[i][0], density = banks[i][1];
        const double bank[][2] = {{0, top + 6},    {30, top},       {62, top + 8}, {104, top + 3},
                                  {136, top + 12}, {147, top + 30}, {147, 460},    {0, 464}};
        dpl_material fog = dpl_build_medium(b, density * 1.1, density, density * 0.85);
        fog.emission[0] = 0.006f;
        fog.emission[1] = 0.008f;
        fog.emission[2] = 0.012f;
        dpl_build_polygon(b, bank, 8, fog);
    }
}

static void add_walls(dpl_scene_builder *b) {
    dpl_material plaster = dpl_build_wall();
    plaster.albedo[0] = 0.72f;
    plaster.albedo[1] = 0.66f;
    plaster.albedo[2] = 0.58f;
    for (size_t i = 0; i < sizeof walls / sizeof walls[0]; i++) {
        const wall *w = &walls[i];
        dpl_build_segment(b, w->from[0], w->from[1], w->to[0], w->to[1], w->width, plaster);
    }
    for (size_t i = 0; i < sizeof leaves / sizeof leaves[0]; i++) {
        dpl_material leaf = dpl_build_wall();
        leaf.albedo[1] = 0.35f;
        dpl_build_disc(b, leaves[i][0], leaves[i][1], leaves[i][2], leaf);
    }
}

/* A garden lattice behind the stained window, balusters upstairs, pillars: combs of thin shadows. */
static void add_lattice(dpl_scene_builder *b) {
    for (int i = 0; i < 9; i++)
        dpl_build_segment(b, 462, 352 + i * 12, 466, 354 + i * 12, 1.6, dpl_build_wall());
    for (int i = 0; i < 5; i++)
        dpl_build_box(b, 172 + i * 22, 320, 1, 7, 0, dpl_build_wall());
    for (int i = 0; i < 3; i++) /* pillars in the lower left room */
        dpl_build_disc(b, 246 + i * 14, 446 - i * 22, 4 - i * 0.5, dpl_build_wall());
}

static void add_lamps(dpl_scene_builder *b) {
    for (size_t i = 0; i < sizeof lamps / sizeof lamps[0]; i++) {
        const lamp *l = &lamps[i];
        dpl_build_disc(b, l->at[0], l->at[1], l->radius, dpl_build_lamp(l->rgb[0], l->rgb[1], l->rgb[2]));
    }
    /* a screen upstairs and the fire downstairs */
    dpl_build_box(b, 288, 300, 1.6, 13, 0.12, dpl_build_lamp(0.16, 0.42, 1.05));
    static const double fire[][2] = {{330, 455}, {334, 440}, {338, 447}, {343, 433},
                                     {348, 446}, {352, 441}, {356, 455}};
    dpl_build_polygon(b, fire, 7, dpl_build_lamp(1.5, 0.45, 0.06));
}

DPL_FAMILY(demo) {
    dpl_scene_builder b = dpl_build_start("demo", seed, index, size, scene, error);
    static const double sky[3] = {0.006, 0.010, 0.022};
    for (int i = 0; i < 3; i++)
        scene->sky[i] = sky[i];
    add_fog(&b);
    add_ground(&b);
    for (size_t i = 0; i < sizeof panes / sizeof panes[0]; i++) {
        const pane *p = &panes[i];
        dpl_build_rectangle(&b, p->corners[0], p->corners[1], p->corners[2], p->corners[3],
                            dpl_build_medium(&b, p->rgb[0], p->rgb[1], p->rgb[2]));
    }
    add_walls(&b);
    add_lattice(&b);
    add_lamps(&b);
    return dpl_build_finish(&b);
}
