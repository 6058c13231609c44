/* The parts of the scene reader. Private to scenes/ and to the tests that feed it pictures of their own. */
#ifndef DPL_SCENES_SCENE_READ_H
#define DPL_SCENES_SCENE_READ_H

#include "json_value.h"
#include "scene.h"

/* Largest scene file [byte]. */
#define DPL_SCENE_FILE_LIMIT ((size_t)256 << 20)

/* Farthest coordinate and largest length [px]. */
#define DPL_SCENE_FAR 1e9

/* Largest radiance, intensity and extinction. */
#define DPL_SCENE_BRIGHT 1e9

/* What opens the pictures that a scene names: dpl_picture_read(), or a stand-in that opens nothing. */
typedef bool (*dpl_scene_picture_reader)(const char *path, dpl_picture_colour colour, dpl_picture *picture,
                                         dpl_error *error);

/* dpl_scene_read_memory() with the picture reader of one's choice. */
bool dpl_scene_read_with(const void *bytes, size_t size, const char *path,
                         dpl_scene_picture_reader read_picture, dpl_scene *scene, dpl_error *error);

/* Reads one entry of "shapes" and appends it. */
bool dpl_scene_read_shape(const dpl_json_node *node, dpl_scene *scene);

/* Reads one entry of "images" and its pictures. What was loaded is in *image also on failure. */
bool dpl_scene_read_image(const dpl_json_node *node, dpl_scene_picture_reader read_picture,
                          dpl_scene_image *image);

/* Reads one entry of "lights". */
bool dpl_scene_read_light(const dpl_json_node *node, dpl_scene_light *light);

/* `name` as seen from the folder of the file `scene`; malloc'ed, NULL when out of memory. */
char *dpl_scene_path_beside(const char *scene, const char *name);

/* Reads an optional [r, g, b] or single number; leaves *rgb alone when the key is missing. */
bool dpl_scene_read_rgb(const dpl_json_node *object, const char *key, double most, double rgb[3]);

/* Reads an optional number, 0 or more; leaves *number alone when the key is missing. */
bool dpl_scene_read_positive(const dpl_json_node *object, const char *key, double most, double *number);

#endif
