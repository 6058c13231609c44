/* Key paths as text: "shapes[2].disc.radius", safe to print on one line. Used by json_value.c and
 * json_locate.c. */
#ifndef DPL_SCENES_JSON_PATH_H
#define DPL_SCENES_JSON_PATH_H

#include <stddef.h>

/* Zero-initialise. What does not fit is left out. */
typedef struct dpl_json_path {
    char text[256];
    size_t length;
} dpl_json_path;

/* Appends ".key" ("key" at the start). Control characters become '?', long keys are cut. */
void dpl_json_path_add_key(dpl_json_path *path, const char *key, size_t length);

/* Appends "[index]". */
void dpl_json_path_add_index(dpl_json_path *path, size_t index);

#endif
