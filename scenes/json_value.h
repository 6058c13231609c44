/* Typed, checked reading of JSON values. A failing call fills the document's error with
 * "FILE:LINE:COL: KEYPATH: what" and returns false. Used by scene_read*.c. */
#ifndef DPL_SCENES_JSON_VALUE_H
#define DPL_SCENES_JSON_VALUE_H

#include "../image/error.h"

#include <jansson.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* A text, for as long as its values are read. */
typedef struct dpl_json_document {
    const char *name; /* stands for the file in errors */
    const char *text;
    size_t size;
    dpl_error *error; /* may be NULL */
} dpl_json_document;

/* A value and how it was reached. Lives on the stack, points up to its parent. */
typedef struct dpl_json_node {
    const dpl_json_document *document;
    const struct dpl_json_node *parent; /* NULL: the whole text */
    const char *key;                    /* in the parent, or NULL */
    size_t index;                       /* in the parent, when it is an array */
    const json_t *value;
} dpl_json_node;

/* Parses the text; the caller gives *value back with json_decref(). */
bool dpl_json_parse(const dpl_json_document *document, json_t **value);

/* The node of the whole text. */
dpl_json_node dpl_json_root(const dpl_json_document *document, const json_t *value);

/* Reports an error at a value. Always false. */
#if defined(__GNUC__)
__attribute__((format(printf, 2, 3)))
#endif
bool dpl_json_fail(const dpl_json_node *node, const char *format, ...);

/* Reports an error at the key of a member. Always false. */
#if defined(__GNUC__)
__attribute__((format(printf, 3, 4)))
#endif
bool dpl_json_fail_key(const dpl_json_node *object, const char *key, const char *format, ...);

/* Is this an object with no other keys than these (NULL at the end)? */
bool dpl_json_object(const dpl_json_node *node, const char *const *allowed);

/* Is this an array of whatever length? No error where it is not. */
bool dpl_json_is_array(const dpl_json_node *node);

/* Is this an array of at least `least` items? */
bool dpl_json_array(const dpl_json_node *node, size_t least);

/* The member, or false (without an error) when there is none. */
bool dpl_json_member(const dpl_json_node *object, const char *key, dpl_json_node *member);

/* The member; an error when there is none. */
bool dpl_json_require(const dpl_json_node *object, const char *key, dpl_json_node *member);

/* An item of an array; `index` must be in range. */
dpl_json_node dpl_json_item(const dpl_json_node *array, size_t index);

/* Number of items of an array, 0 for anything else. */
size_t dpl_json_count(const dpl_json_node *array);

/* A number from `least` to `most`. */
bool dpl_json_number(const dpl_json_node *node, double least, double most, double *number);

/* A whole number from `least` to `most`. */
bool dpl_json_whole(const dpl_json_node *node, int32_t least, int32_t most, int32_t *number);

/* An array of exactly `count` numbers. */
bool dpl_json_numbers(const dpl_json_node *node, size_t count, double least, double most, double *numbers);

/* [r, g, b], or one number for all three. */
bool dpl_json_rgb(const dpl_json_node *node, double least, double most, double rgb[3]);

/* A string that is not empty; belongs to the document. */
bool dpl_json_string(const dpl_json_node *node, const char **string);

#endif
