/* Checked accessors over jansson. Integers are parsed as reals: a scene means the same by 3 and 3.0, and a
 * number too long for an integer is then judged by its range, with its key named. */
#include "json_value.h"

#include "json_locate.h"
#include "number_text.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

/* Deepest value of a scene: shapes[i].polygon.points[j][k] is 6 steps. */
#define MAX_STEPS 16

static void report(const dpl_json_document *document, dpl_json_position position, const dpl_json_path *path,
                   const char *what) {
    dpl_error_set(document->error, "%s:%zu:%zu: %s%s%s", document->name, position.line, position.column,
                  path->text, path->length > 0 ? ": " : "", what);
}

static void clean_line(char *text) {
    for (; *text; text++)
        if ((unsigned char)*text < 0x20 || *text == 0x7f)
            *text = '?';
}

bool dpl_json_parse(const dpl_json_document *document, json_t **value) {
    json_error_t error;
    *value =
        json_loadb(document->text, document->size, JSON_REJECT_DUPLICATES | JSON_DECODE_INT_AS_REAL, &error);
    if (*value)
        return true;
    dpl_json_path path = {.length = 0};
    /* A text that stops too early is wrong behind its last token. */
    bool cut = json_error_code(&error) == json_error_premature_end_of_input;
    size_t offset = cut ? document->size + 1 : error.position > 0 ? (size_t)error.position : 0;
    dpl_json_position position = dpl_json_locate_token(document->text, document->size, offset, &path);
    clean_line(error.text);
    report(document, position, &path, error.text);
    return false;
}

dpl_json_node dpl_json_root(const dpl_json_document *document, const json_t *value) {
    return (dpl_json_node){.document = document, .value = value};
}

/* Steps from the root to the node; returns how many. */
static size_t steps_to(const dpl_json_node *node, dpl_json_step steps[MAX_STEPS]) {
    size_t count = 0;
    for (const dpl_json_node *n = node; n->parent && count < MAX_STEPS; n = n->parent)
        count++;
    size_t i = count;
    for (const dpl_json_node *n = node; i > 0; n = n->parent)
        steps[--i] = (dpl_json_step){n->key, n->index};
    return count;
}

static dpl_json_path path_of(const dpl_json_step *steps, size_t count) {
    dpl_json_path path = {.length = 0};
    for (size_t i = 0; i < count; i++) {
        if (steps[i].key)
            dpl_json_path_add_key(&path, steps[i].key, strlen(steps[i].key));
        else
            dpl_json_path_add_index(&path, steps[i].index);
    }
    return path;
}

static void fail_at(const dpl_json_node *node, bool of_key, const char *what) {
    dpl_json_step steps[MAX_STEPS];
    size_t count = steps_to(node, steps);
    dpl_json_path path = path_of(steps, count);
    const dpl_json_document *document = node->document;
    report(document, dpl_json_locate(document->text, document->size, steps, count, of_key), &path, what);
}

bool dpl_json_fail(const dpl_json_node *node, const char *format, ...) {
    char what[sizeof(dpl_error)];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(what, sizeof what, format, arguments);
    va_end(arguments);
    fail_at(node, false, what);
    return false;
}

bool dpl_json_fail_key(const dpl_json_node *object, const char *key, const char *format, ...) {
    char what[sizeof(dpl_error)];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(what, sizeof what, format, arguments);
    va_end(arguments);
    dpl_json_node member = {.document = object->document, .parent = object, .key = key};
    fail_at(&member, true, what);
    return false;
}

static const char *type_name(const json_t *value) {
    static const char *const names[] = {"an object", "an array", "a string", "a number",
                                        "a number",  "true",     "false",    "null"};
    size_t type = (size_t)json_typeof(value);
    return type < sizeof names / sizeof names[0] ? names[type] : "something else";
}

static bool must_be(const dpl_json_node *node, const char *what) {
    return dpl_json_fail(node, "must be %s (is %s)", what, type_name(node->value));
}

static bool is_listed(const char *key, const char *const *list) {
    for (; *list; list++)
        if (strcmp(key, *list) == 0)
            return true;
    return false;
}

static bool unknown_key(const dpl_json_node *node, const char *key, const char *const *allowed) {
    char list[256] = "";
    for (size_t used = 0; *allowed && used < sizeof list; allowed++)
        used += (size_t)snprintf(list + used, sizeof list - used, "%s%s", used > 0 ? ", " : "", *allowed);
    return dpl_json_fail_key(node, key, "unknown key; allowed here: %s", list);
}

bool dpl_json_object(const dpl_json_node *node, const char *const *allowed) {
    if (!json_is_object(node->value))
        return must_be(node, "an object");
    /* jansson's iterators take a non-const object but do not change it. */
    json_t *object = (json_t *)(uintptr_t)node->value;
    for (void *iterator = json_object_iter(object); iterator;
         iterator = json_object_iter_next(object, iterator)) {
        const char *key = json_object_iter_key(iterator);
        if (!is_listed(key, allowed))
            return unknown_key(node, key, allowed);
    }
    return true;
}

bool dpl_json_is_array(const dpl_json_node *node) {
    return json_is_array(node->value);
}

bool dpl_json_array(const dpl_json_node *node, size_t least) {
    if (!json_is_array(node->value))
        return must_be(node, "an array");
    size_t count = json_array_size(node->value);
    if (count < least)
        return dpl_json_fail(node, "needs at least %zu items (has %zu)", least, count);
    return true;
}

bool dpl_json_member(const dpl_json_node *object, const char *key, dpl_json_node *member) {
    const json_t *value = json_object_get(object->value, key);
    *member = (dpl_json_node){.document = object->document, .parent = object, .key = key, .value = value};
    return value != NULL;
}

bool dpl_json_require(const dpl_json_node *object, const char *key, dpl_json_node *member) {
    if (dpl_json_member(object, key, member))
        return true;
    /* The key is not in the text: its path, but the position of the object that lacks it. */
    return dpl_json_fail(member, "is required but missing");
}

dpl_json_node dpl_json_item(const dpl_json_node *array, size_t index) {
    return (dpl_json_node){.document = array->document,
                           .parent = array,
                           .index = index,
                           .value = json_array_get(array->value, index)};
}

size_t dpl_json_count(const dpl_json_node *array) {
    return json_array_size(array->value);
}

static bool out_of_range(const dpl_json_node *node, double least, double most, double number) {
    dpl_number_text is = dpl_number_text_double(number);
    if (number < least && fpclassify(least) == FP_ZERO)
        return dpl_json_fail(node, "must not be negative (is %s)", is.text);
    if (number < least)
        return dpl_json_fail(node, "must be at least %s (is %s)", dpl_number_text_double(least).text,
                             is.text);
    return dpl_json_fail(node, "must be at most %s (is %s)", dpl_number_text_double(most).text, is.text);
}

bool dpl_json_number(const dpl_json_node *node, double least, double most, double *number) {
    if (!json_is_number(node->value))
        return must_be(node, "a number");
    double value = json_number_value(node->value);
    if (!isfinite(value))
        return dpl_json_fail(node, "must be finite");
    if (value < least || value > most)
        return out_of_range(node, least, most, value);
    *number = value;
    return true;
}

bool dpl_json_whole(const dpl_json_node *node, int32_t least, int32_t most, int32_t *number) {
    double value = 0;
    if (!dpl_json_number(node, least, most, &value))
        return false;
    if (value < floor(value) || value > floor(value))
        return dpl_json_fail(node, "must be a whole number (is %s)", dpl_number_text_double(value).text);
    *number = (int32_t)value;
    return true;
}

bool dpl_json_numbers(const dpl_json_node *node, size_t count, double least, double most, double *numbers) {
    if (!json_is_array(node->value))
        return dpl_json_fail(node, "must be an array of %zu numbers (is %s)", count, type_name(node->value));
    if (json_array_size(node->value) != count)
        return dpl_json_fail(node, "must have %zu numbers (has %zu)", count, json_array_size(node->value));
    for (size_t i = 0; i < count; i++) {
        dpl_json_node item = dpl_json_item(node, i);
        if (!dpl_json_number(&item, least, most, &numbers[i]))
            return false;
    }
    return true;
}

bool dpl_json_rgb(const dpl_json_node *node, double least, double most, double rgb[3]) {
    if (json_is_array(node->value))
        return dpl_json_numbers(node, 3, least, most, rgb);
    if (!json_is_number(node->value))
        return must_be(node, "a number or [r, g, b]");
    if (!dpl_json_number(node, least, most, &rgb[0]))
        return false;
    rgb[1] = rgb[2] = rgb[0];
    return true;
}

bool dpl_json_string(const dpl_json_node *node, const char **string) {
    if (!json_is_string(node->value))
        return must_be(node, "a string");
    *string = json_string_value(node->value);
    if (**string == '\0')
        return dpl_json_fail(node, "must not be empty");
    return true;
}
