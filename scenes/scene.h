/* Scenes as data: what a scene file says, before it becomes a field. Used by tools, tests and bench; not part
 * of the core library. */
#ifndef DPL_SCENES_SCENE_H
#define DPL_SCENES_SCENE_H

#include "../image/error.h"
#include "../image/picture.h"

#include <dapple/field.h>
#include <dapple/shape.h>

/* Pictures laid into the scene, before the shapes. Paths are as written in the scene file (relative to it).
 */
typedef struct dpl_scene_image {
    char *emission; /* path or NULL */
    char *extinction;
    char *albedo;
    dpl_picture emission_picture; /* loaded; zeroed where the path is NULL */
    dpl_picture extinction_picture;
    dpl_picture albedo_picture;
    int32_t at[2]; /* top left corner [px] */
    double intensity;
} dpl_scene_image;

/* A disc area light for the shadow module. */
typedef struct dpl_scene_light {
    double position[2]; /* [px] */
    double radius;      /* [px] */
    double color[3];
    double intensity;
} dpl_scene_light;

/* Owns everything it points to, polygon points included. Zero-initialise; free with dpl_scene_free(). */
typedef struct dpl_scene {
    int32_t width;
    int32_t height;
    int32_t margin;        /* of the world around the picture [px] */
    double sky[3];         /* where there is no ring */
    double (*sky_ring)[3]; /* as in dpl_field_set_sky_ring(), or NULL */
    int32_t sky_sectors;   /* of the ring */
    dpl_scene_image *images;
    int32_t image_count;
    dpl_shape *shapes; /* grown by dpl_scene_add_shape() alone */
    int32_t shape_count;
    int32_t shape_capacity; /* room in `shapes` */
    dpl_scene_light *lights;
    int32_t light_count;
} dpl_scene;

/* Reads a scene file (JSON), or any PNG as walls and lamps: alpha is opacity, colour is emission; a PNG
 * without alpha is opaque where it is not black. Errors are "FILE:LINE:COL: KEY: what". Images are loaded. */
bool dpl_scene_read(const char *path, dpl_scene *scene, dpl_error *error);

/* The same from memory: `path` stands for the file in errors and is where images are looked up. */
bool dpl_scene_read_memory(const void *bytes, size_t size, const char *path, dpl_scene *scene,
                           dpl_error *error);

/* Writes a scene file that reads back to the same scene (pictures are named, not written). */
bool dpl_scene_write(const char *path, const dpl_scene *scene, dpl_error *error);

void dpl_scene_free(dpl_scene *scene);

/* Appends a copy of a shape (with its own polygon points). False when out of memory. */
bool dpl_scene_add_shape(dpl_scene *scene, const dpl_shape *shape, dpl_error *error);

/* Makes the field: sky, then images, then shapes. `keep_shape_distance` as in dpl_field_desc. */
bool dpl_scene_build_field(const dpl_scene *scene, dpl_context *context, bool keep_shape_distance,
                           dpl_field **field, dpl_error *error);

/* Draws the scene into a field that exists already (cleared first). False when size or margin differ. */
bool dpl_scene_draw(const dpl_scene *scene, dpl_context *context, dpl_field *field, dpl_error *error);

#endif
