/* Where in a JSON text something stands, which jansson tells for syntax errors only: a small tokenizer that
 * walks the text again. Called by json_value.c once there is an error to report. */
#ifndef DPL_SCENES_JSON_LOCATE_H
#define DPL_SCENES_JSON_LOCATE_H

#include "json_path.h"

#include <stdbool.h>
#include <stddef.h>

/* One step from a value down to one of its parts. */
typedef struct dpl_json_step {
    const char *key; /* member of an object (UTF-8), or NULL */
    size_t index;    /* item of an array, when `key` is NULL */
} dpl_json_step;

/* Both count from 1; a column is a character (code point), as editors count them. */
typedef struct dpl_json_position {
    size_t line;
    size_t column;
} dpl_json_position;

/* Finds the value that `steps` lead to in a valid text, or with `of_key` the key of the last step. */
dpl_json_position dpl_json_locate(const char *text, size_t size, const dpl_json_step *steps, size_t count,
                                  bool of_key);

/* Finds the start of the token that ends at or behind byte `offset`, and the key path it belongs to, in a
 * text that is valid JSON up to there. */
dpl_json_position dpl_json_locate_token(const char *text, size_t size, size_t offset, dpl_json_path *path);

#endif
