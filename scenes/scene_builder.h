/* Adding shapes to a scene in one line each, with one check at the end. Used by the scene families. */
#ifndef DPL_SCENES_SCENE_BUILDER_H
#define DPL_SCENES_SCENE_BUILDER_H

#include "random.h"
#include "scene.h"

/* Families are laid out on a square of this many pixels and scaled to the size asked for. */
#define DPL_SCENE_BASE 512.0

/* A scene in the making. Coordinates and lengths given to dpl_build_* are multiplied by `scale`. */
typedef struct dpl_scene_builder {
    dpl_scene *scene;
    dpl_error *error;
    dpl_random random;
    double scale; /* size / DPL_SCENE_BASE; a family that counts real pixels sets it to 1 */
    bool good;    /* false once something has failed: later calls do nothing */
} dpl_scene_builder;

/* Starts an empty scene of size x size pixels, with random numbers that depend on the family's name, the seed
 * and the index alone. */
dpl_scene_builder dpl_build_start(const char *family, uint64_t seed, int32_t index, int32_t size,
                                  dpl_scene *scene, dpl_error *error);

/* True when all went well; otherwise the scene is freed. */
bool dpl_build_finish(dpl_scene_builder *builder);

/* A number from the builder's stream, uniform in [low, high). */
double dpl_build_draw(dpl_scene_builder *builder, double low, double high);

/* A ring of sky; see dpl_scene. */
void dpl_build_sky_ring(dpl_scene_builder *builder, const double (*rgb)[3], int32_t count);

void dpl_build_disc(dpl_scene_builder *builder, double x, double y, double radius, dpl_material material);
void dpl_build_box(dpl_scene_builder *builder, double x, double y, double half_width, double half_height,
                   double angle, dpl_material material);
/* By corners, not turned. */
void dpl_build_rectangle(dpl_scene_builder *builder, double left, double top, double right, double bottom,
                         dpl_material material);
void dpl_build_segment(dpl_scene_builder *builder, double x0, double y0, double x1, double y1, double width,
                       dpl_material material);
/* At most 16 points. */
void dpl_build_polygon(dpl_scene_builder *builder, const double (*points)[2], int32_t count,
                       dpl_material material);

/* The scene's light: a white disc of intensity 4. Once per scene. */
void dpl_build_light(dpl_scene_builder *builder, double x, double y, double radius);

/* Black and opaque. */
dpl_material dpl_build_wall(void);

/* Opaque, shining with this colour. */
dpl_material dpl_build_lamp(double red, double green, double blue);

/* A black box of random half sizes from the range, turned any way. */
void dpl_build_turned_box(dpl_scene_builder *builder, double x, double y, double least, double most);

/* A lamp of a random colour: dpl_build_random_lamp() is drawn in the call, so that only one argument may be a
 * draw itself: C does not say in which order arguments are evaluated, and the order must be the same
 * everywhere. */
void dpl_build_lit_disc(dpl_scene_builder *builder, double x, double y, double radius, double least,
                        double most);

/* Opaque, of a random bright colour times an intensity from the range. */
dpl_material dpl_build_random_lamp(dpl_scene_builder *builder, double least, double most);

/* Not opaque: extinction per base pixel, so that a scaled scene looks the same. */
dpl_material dpl_build_medium(const dpl_scene_builder *builder, double red, double green, double blue);

/* Hue, saturation, lightness, each 0 .. 1. */
void dpl_colour_from_hsl(double hue, double saturation, double lightness, double rgb[3]);

#endif
