/* Builds key paths. */
#include "json_path.h"

#include <stdio.h>
#include <string.h>

/* Longest part of a key that is shown [byte]. */
#define KEY_SHOWN 48

static void add_byte(dpl_json_path *path, char byte) {
    if (path->length + 1 < sizeof path->text) {
        path->text[path->length++] = (unsigned char)byte < 0x20 || byte == 0x7f ? '?' : byte;
        path->text[path->length] = '\0';
    }
}

void dpl_json_path_add_key(dpl_json_path *path, const char *key, size_t length) {
    size_t shown = length > KEY_SHOWN ? KEY_SHOWN : length;
    /* Not in the middle of a UTF-8 sequence. */
    while (shown < length && shown > 0 && ((unsigned char)key[shown] & 0xc0) == 0x80)
        shown--;
    if (path->length > 0)
        add_byte(path, '.');
    for (size_t i = 0; i < shown; i++)
        add_byte(path, key[i]);
    for (int i = 0; shown < length && i < 3; i++)
        add_byte(path, '.');
}

void dpl_json_path_add_index(dpl_json_path *path, size_t index) {
    char digits[32];
    snprintf(digits, sizeof digits, "[%zu]", index);
    for (const char *digit = digits; *digit; digit++)
        add_byte(path, *digit);
}
