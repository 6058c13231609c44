/* Picks the format: a reader by a file's first bytes, a writer by a path's extension. Called by scenes/,
 * tools, tests and bench. */
#include "file.h"
#include "formats.h"
#include "picture.h"

#include <stdlib.h>
#include <string.h>

/* The largest picture as uncompressed floats, with room for headers and tables. */
#define FILE_LIMIT ((uint64_t)DPL_PICTURE_MAX_SIZE * DPL_PICTURE_MAX_SIZE * 16 + (1 << 24))

typedef bool read_function(const dpl_picture_source *source, dpl_picture *picture, dpl_error *error);
typedef bool write_function(const char *path, const dpl_picture *picture, dpl_error *error);

static const struct {
    const char *magic;
    size_t size;
    read_function *read;
} readers[] = {
    {"\x89PNG\r\n\x1a\n", 8, dpl_png_read},
    {"PF", 2, dpl_pfm_read},
    {"Pf", 2, dpl_pfm_read},
    {"\x76\x2f\x31\x01", 4, dpl_exr_read},
};

static const struct {
    const char *extension;
    write_function *write; /* NULL: not for linear floats */
} writers[] = {
    {".png", NULL},
    {".pfm", dpl_pfm_write},
    {".exr", dpl_exr_write},
};

#define COUNT(array) (sizeof(array) / sizeof *(array))

/* ---- Reading -------------------------------------------------------------------------------------- */

bool dpl_picture_read_memory(const void *bytes, size_t size, const char *name, dpl_picture_colour colour,
                             dpl_picture *picture, dpl_error *error) {
    *picture = (dpl_picture){0};
    const dpl_picture_source source = {.bytes = bytes, .size = size, .name = name, .colour = colour};
    for (size_t i = 0; i < COUNT(readers); i++)
        if (size >= readers[i].size && memcmp(bytes, readers[i].magic, readers[i].size) == 0)
            return readers[i].read(&source, picture, error);
    return dpl_error_set(error, "%s: not a picture that can be read (PNG, PFM or EXR)", name);
}

bool dpl_picture_read(const char *path, dpl_picture_colour colour, dpl_picture *picture, dpl_error *error) {
    *picture = (dpl_picture){0};
    char *bytes;
    size_t size;
    size_t limit = FILE_LIMIT < SIZE_MAX / 2 ? (size_t)FILE_LIMIT : SIZE_MAX / 2;
    if (!dpl_file_read(path, limit, &bytes, &size, error))
        return false;
    bool good = dpl_picture_read_memory(bytes, size, path, colour, picture, error);
    free(bytes);
    return good;
}

/* ---- Writing -------------------------------------------------------------------------------------- */

static char lower(char letter) {
    return letter >= 'A' && letter <= 'Z' ? (char)(letter - 'A' + 'a') : letter;
}

static bool ends_with(const char *path, const char *extension) {
    size_t path_size = strlen(path), size = strlen(extension);
    if (path_size < size)
        return false;
    for (size_t i = 0; i < size; i++)
        if (lower(path[path_size - size + i]) != extension[i])
            return false;
    return true;
}

/* The row of `writers` for a path, or -1 with the error set. */
static int find_writer(const char *path, dpl_error *error) {
    const char *name = strcmp(path, "-") == 0 ? ".pfm" : path;
    for (size_t i = 0; i < COUNT(writers); i++) {
        if (!ends_with(name, writers[i].extension))
            continue;
        if (writers[i].write == dpl_exr_write && !dpl_picture_has_exr()) {
            dpl_error_set(error, "%s: this build writes no EXR; use .pfm or .png", path);
            return -1;
        }
        return (int)i;
    }
    dpl_error_set(error, "%s: the name must end in .png, .pfm or .exr", path);
    return -1;
}

bool dpl_picture_can_write(const char *path, dpl_error *error) {
    return find_writer(path, error) >= 0;
}

bool dpl_picture_write(const char *path, const dpl_picture *picture, dpl_error *error) {
    int writer = find_writer(path, error);
    if (writer < 0)
        return false;
    if (!writers[writer].write)
        return dpl_error_set(error, "%s: linear values go into .pfm or .exr", path);
    if (!picture->data || picture->width < 1 || picture->height < 1 || picture->channels < 1 ||
        picture->channels > 4)
        return dpl_error_set(error, "%s: there is no picture to write", path);
    return writers[writer].write(path, picture, error);
}
