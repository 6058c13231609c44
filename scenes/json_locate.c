/* Walks JSON text to a key path, or to a byte offset. Every loop stops at the end of the text, so that a
 * text that turns out to be broken gives a wrong position at worst. */
#include "json_locate.h"

#include <string.h>

/* Objects and arrays inside each other that a path shows. Scenes have five. */
#define MAX_DEPTH 16

typedef struct cursor {
    const char *text;
    size_t size;
    size_t at;
} cursor;

static bool at_any(const cursor *c, const char *set) {
    return c->at < c->size && c->text[c->at] != '\0' && strchr(set, c->text[c->at]);
}

static void skip_space(cursor *c) {
    while (at_any(c, " \t\r\n"))
        c->at++;
}

/* From the opening quote to behind the closing one. */
static void skip_string(cursor *c) {
    c->at++;
    while (c->at < c->size && !at_any(c, "\"\n"))
        c->at += c->text[c->at] == '\\' && c->at + 1 < c->size ? 2 : 1;
    if (at_any(c, "\""))
        c->at++;
}

static void skip_token(cursor *c) {
    if (at_any(c, "\"")) {
        skip_string(c);
    } else if (at_any(c, "{}[],:")) {
        c->at++;
    } else {
        while (c->at < c->size && !at_any(c, "{}[],:\" \t\r\n"))
            c->at++;
    }
}

/* Without recursion: the nesting is the file's to choose. */
static void skip_value(cursor *c) {
    size_t depth = 0;
    do {
        skip_space(c);
        if (at_any(c, "{["))
            depth++;
        else if (at_any(c, "}]") && depth > 0)
            depth--;
        skip_token(c);
    } while (depth > 0 && c->at < c->size);
}

static unsigned hex_value(const char *digits) {
    unsigned value = 0;
    for (int i = 0; i < 4; i++) {
        char digit = digits[i];
        unsigned nibble = digit <= '9' ? (unsigned)(digit - '0') : (unsigned)((digit | 0x20) - 'a' + 10);
        value = value << 4 | (nibble & 15);
    }
    return value;
}

/* Bytes written. */
static size_t encode_utf8(unsigned code, char bytes[4]) {
    static const unsigned char lead[5] = {0, 0x00, 0xc0, 0xe0, 0xf0};
    size_t count = code < 0x80 ? 1 : code < 0x800 ? 2 : code < 0x10000 ? 3 : 4;
    for (size_t i = count; i-- > 1; code >>= 6)
        bytes[i] = (char)(0x80 | (code & 0x3f));
    bytes[0] = (char)(lead[count] | code);
    return count;
}

/* Decodes what stands at *at (a plain byte or an escape) and moves behind it. Returns the bytes written. */
static size_t decode_character(const cursor *c, size_t *at, char bytes[4]) {
    const char *from = c->text + *at;
    size_t left = c->size - *at;
    if (from[0] != '\\' || left < 2) {
        bytes[0] = from[0];
        *at += 1;
        return 1;
    }
    if (from[1] != 'u' || left < 6) {
        static const char names[] = "bfnrt", meanings[] = "\b\f\n\r\t";
        const char *name = from[1] ? strchr(names, from[1]) : NULL;
        bytes[0] = name ? meanings[name - names] : from[1];
        *at += 2;
        return 1;
    }
    unsigned code = hex_value(from + 2);
    *at += 6;
    if (code >= 0xd800 && code < 0xdc00 && left >= 12) {
        code = 0x10000 + ((code - 0xd800) << 10) + ((hex_value(from + 8) - 0xdc00) & 0x3ff);
        *at += 6;
    }
    return encode_utf8(code, bytes);
}

/* Is the string that starts at the cursor's quote this key? */
static bool string_is(const cursor *c, const char *key) {
    size_t at = c->at + 1;
    while (at < c->size && c->text[at] != '"') {
        char bytes[4];
        size_t count = decode_character(c, &at, bytes);
        if (*key == '\0' || strncmp(key, bytes, count) != 0)
            return false;
        key += count;
    }
    return *key == '\0';
}

/* From an object to its member's value; *key_at receives where the key starts. */
static bool enter_member(cursor *c, const char *key, size_t *key_at) {
    if (!at_any(c, "{"))
        return false;
    c->at++;
    for (skip_space(c); at_any(c, "\""); skip_space(c)) {
        bool found = string_is(c, key);
        *key_at = c->at;
        skip_string(c);
        skip_space(c);
        if (at_any(c, ":"))
            c->at++;
        skip_space(c);
        if (found)
            return true;
        skip_value(c);
        skip_space(c);
        if (at_any(c, ","))
            c->at++;
    }
    return false;
}

static bool enter_item(cursor *c, size_t index) {
    if (!at_any(c, "["))
        return false;
    c->at++;
    for (skip_space(c); index > 0 && c->at < c->size; index--) {
        skip_value(c);
        skip_space(c);
        if (at_any(c, ","))
            c->at++;
        skip_space(c);
    }
    return true;
}

static dpl_json_position position_of(const char *text, size_t offset) {
    dpl_json_position position = {1, 1};
    for (size_t i = 0; i < offset; i++) {
        if (text[i] == '\n') {
            position.line++;
            position.column = 1;
        } else if (((unsigned char)text[i] & 0xc0) != 0x80) {
            position.column++;
        }
    }
    return position;
}

dpl_json_position dpl_json_locate(const char *text, size_t size, const dpl_json_step *steps, size_t count,
                                  bool of_key) {
    cursor c = {text, size, 0};
    skip_space(&c);
    size_t key_at = c.at;
    for (size_t i = 0; i < count; i++) {
        cursor next = c;
        if (steps[i].key ? !enter_member(&next, steps[i].key, &key_at) : !enter_item(&next, steps[i].index))
            break; /* a missing member: its object is where to look */
        c = next;
    }
    return position_of(text, of_key ? key_at : c.at);
}

/* What the walk to an offset is inside of. */
typedef struct frame {
    bool array;
    bool key_next; /* object: the next string is a key */
    size_t index;  /* array: the item */
    size_t key;    /* object: behind the opening quote of the key */
    size_t key_length;
} frame;

typedef struct walk {
    frame frames[MAX_DEPTH];
    size_t depth; /* may exceed MAX_DEPTH, the frames beyond are not kept */
} walk;

static void walk_key(walk *w, size_t start, size_t end) {
    frame *top = w->depth > 0 && w->depth <= MAX_DEPTH ? &w->frames[w->depth - 1] : NULL;
    if (top && !top->array && top->key_next) {
        top->key = start + 1;
        top->key_length = end > start + 2 ? end - start - 2 : 0;
    }
}

static void walk_mark(walk *w, char mark) {
    if (mark == '{' || mark == '[') {
        if (w->depth < MAX_DEPTH)
            w->frames[w->depth] = (frame){.array = mark == '[', .key_next = mark == '{'};
        w->depth++;
        return;
    }
    if (mark == '}' || mark == ']') {
        w->depth -= w->depth > 0;
        return;
    }
    frame *top = w->depth > 0 && w->depth <= MAX_DEPTH ? &w->frames[w->depth - 1] : NULL;
    if (!top)
        return;
    if (mark == ',') {
        top->index++;
        top->key_next = !top->array;
        top->key = 0;
    } else if (mark == ':') {
        top->key_next = false;
    }
}

dpl_json_position dpl_json_locate_token(const char *text, size_t size, size_t offset, dpl_json_path *path) {
    cursor c = {text, size, 0};
    walk w = {.depth = 0};
    size_t start;
    for (;;) {
        skip_space(&c);
        start = c.at;
        if (c.at >= size)
            break;
        skip_token(&c);
        if (text[start] == '"')
            walk_key(&w, start, c.at);
        if (c.at >= offset)
            break;
        if (strchr("{}[],:", text[start]))
            walk_mark(&w, text[start]);
    }
    size_t shown = w.depth < MAX_DEPTH ? w.depth : MAX_DEPTH;
    for (size_t i = 0; i < shown; i++) {
        const frame *f = &w.frames[i];
        if (f->array)
            dpl_json_path_add_index(path, f->index);
        else if (f->key > 0)
            dpl_json_path_add_key(path, text + f->key, f->key_length);
    }
    return position_of(text, start);
}
