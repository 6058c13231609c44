/* The family "fog": lamps and walls among coloured media that let some light through, some of which glow.
 * Called through the table in families.c. */
#include "family_list.h"
#include "scene_builder.h"

/* From a haze to stained glass: between e^-0.1 and e^-10 is left after 100 base pixels. */
static dpl_material draw_medium(dpl_scene_builder *b) {
    double density = dpl_build_draw(b, 0.05, 0.3);
    double red = density * density * dpl_build_draw(b, 0.1, 1);
    double green = density * density * dpl_build_draw(b, 0.1, 1);
    double blue = density * density * dpl_build_draw(b, 0.1, 1);
    dpl_material medium = dpl_build_medium(b, red, green, blue);
    if (dpl_random_below(&b->random, 4) == 0)
        for (int k = 0; k < 3; k++)
            medium.emission[k] = (float)dpl_build_draw(b, 0, 0.4);
    return medium;
}

static void add_cloud(dpl_scene_builder *b) {
    dpl_material medium = draw_medium(b);
    double x = dpl_build_draw(b, 40, 472), y = dpl_build_draw(b, 40, 472),
           radius = dpl_build_draw(b, 20, 110);
    if (dpl_random_below(&b->random, 2) == 0) {
        dpl_build_disc(b, x, y, radius, medium);
        return;
    }
    double half_height = dpl_build_draw(b, 4, 80), angle = dpl_build_draw(b, 0, 3.1);
    dpl_build_box(b, x, y, radius, half_height, angle, medium);
}

DPL_FAMILY(fog) {
    dpl_scene_builder b = dpl_build_start("fog", seed, index, size, scene, error);
    int32_t clouds = 3 + dpl_random_below(&b.random, 8), lamps = 2 + dpl_random_below(&b.random, 6);
    int32_t boxes = 1 + dpl_random_below(&b.random, 6);
    for (int32_t i = 0; i < clouds; i++)
        add_cloud(&b);
    for (int32_t i = 0; i < boxes; i++) {
        double x = dpl_build_draw(&b, 40, 472), y = dpl_build_draw(&b, 40, 472);
        dpl_build_turned_box(&b, x, y, 4, 35);
    }
    for (int32_t i = 0; i < lamps; i++) {
        double x = dpl_build_draw(&b, 30, 482), y = dpl_build_draw(&b, 30, 482);
        dpl_build_lit_disc(&b, x, y, dpl_build_draw(&b, 4, 15), 1, 5);
    }
    return dpl_build_finish(&b);
}
