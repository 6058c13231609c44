/* The 50 random scenes of the ARC paper's benchmark, seeded: black boxes and coloured discs under a faint
 * sky. Called through the table in families.c. */
#include "family_list.h"
#include "scene_builder.h"

/* Every number of lights with every number of occluders, in this order, until there are 50. */
typedef struct arc_block {
    int32_t lights[8];
    int32_t light_count;
    int32_t occluders[3];
    int32_t occluder_count;
} arc_block;

static const arc_block blocks[] = {
    {{1, 2, 3, 4, 5}, 5, {1, 3}, 2},
    {{6, 7, 8, 10, 12, 15}, 6, {2, 5, 8}, 3},
    {{18, 20, 25, 30, 35, 40, 45, 50}, 8, {3, 5, 8}, 3},
};

void dpl_scene_arc_configuration(int32_t index, int32_t *lights, int32_t *occluders) {
    *lights = *occluders = 0;
    for (size_t i = 0; i < sizeof blocks / sizeof blocks[0] && index >= 0; i++) {
        int32_t per_light = blocks[i].occluder_count;
        if (index < blocks[i].light_count * per_light) {
            *lights = blocks[i].lights[index / per_light];
            *occluders = blocks[i].occluders[index % per_light];
            return;
        }
        index -= blocks[i].light_count * per_light;
    }
}

/* The order of the draws is the paper's program's; each draw is a statement of its own to keep it. */
static void add_occluder(dpl_scene_builder *b) {
    double x = dpl_build_draw(b, 50, 462);
    double y = dpl_build_draw(b, 50, 462);
    double half_width = dpl_build_draw(b, 5, 35);
    double half_height = dpl_build_draw(b, 5, 65);
    dpl_build_box(b, x, y, half_width, half_height, 0, dpl_build_wall());
}

static void add_light(dpl_scene_builder *b) {
    double x = dpl_build_draw(b, 30, 482);
    double y = dpl_build_draw(b, 30, 482);
    double radius = dpl_build_draw(b, 3, 18);
    double hue = dpl_build_draw(b, 0, 1);
    double saturation = dpl_build_draw(b, 0.7, 1);
    double lightness = dpl_build_draw(b, 0.5, 0.8);
    double intensity = dpl_build_draw(b, 0.5, 2);
    double rgb[3];
    dpl_colour_from_hsl(hue, saturation, lightness, rgb);
    dpl_build_disc(b, x, y, radius,
                   dpl_build_lamp(rgb[0] * intensity, rgb[1] * intensity, rgb[2] * intensity));
}

DPL_FAMILY(arc) {
    dpl_scene_builder b = dpl_build_start("arc", seed, index, size, scene, error);
    static const double sky[3] = {0.02, 0.03, 0.05};
    int32_t lights, occluders;
    dpl_scene_arc_configuration(index, &lights, &occluders);
    if (lights == 0)
        b.good = dpl_error_set(error, "arc: there are scenes 0 to 49, but no %d", index);
    for (int i = 0; i < 3; i++)
        scene->sky[i] = sky[i];
    for (int32_t i = 0; i < occluders; i++)
        add_occluder(&b);
    for (int32_t i = 0; i < lights; i++)
        add_light(&b);
    return dpl_build_finish(&b);
}
