/* Asks the file system, and makes folders. */
#define _POSIX_C_SOURCE 200809L
#include "paths.h"

#include <ctype.h>
#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static bool fail(dpl_error *error, const char *path, int code) {
    return dpl_error_set(error, "%s: %s", path, strerror(code));
}

/* The folder that a path lies in, as malloc'ed text: "." and "/" included. */
static char *folder_of(const char *path) {
    const char *slash = strrchr(path, '/');
    size_t length = !slash ? 1 : slash == path ? 1 : (size_t)(slash - path);
    char *folder = malloc(length + 1);
    if (!folder)
        return NULL;
    memcpy(folder, slash ? path : ".", length);
    folder[length] = 0;
    return folder;
}

static bool check_folder(const char *path, dpl_error *error) {
    char *folder = folder_of(path);
    if (!folder)
        return fail(error, path, ENOMEM);
    struct stat found;
    int code = 0;
    if (stat(folder, &found) != 0)
        code = errno;
    else if (!S_ISDIR(found.st_mode))
        code = ENOTDIR;
    else if (access(folder, W_OK | X_OK) != 0)
        code = errno;
    free(folder);
    return code == 0 || fail(error, path, code);
}

bool dpl_path_check_writable(const char *path, dpl_error *error) {
    struct stat found;
    if (strcmp(path, "-") == 0)
        return true;
    if (stat(path, &found) == 0) {
        if (S_ISDIR(found.st_mode))
            return fail(error, path, EISDIR);
        if (access(path, W_OK) != 0)
            return fail(error, path, errno);
        if (!S_ISREG(found.st_mode)) /* a device or pipe is written as it is, not replaced */
            return true;
    }
    return check_folder(path, error);
}

static bool make_one(const char *path, dpl_error *error) {
    struct stat found;
    if (mkdir(path, 0777) == 0)
        return true;
    int code = errno;
    if (stat(path, &found) == 0)
        return S_ISDIR(found.st_mode) || fail(error, path, ENOTDIR);
    return fail(error, path, code);
}

bool dpl_path_make_folder(const char *path, dpl_error *error) {
    size_t length = strlen(path);
    char *part = malloc(length + 1);
    if (!part)
        return fail(error, path, ENOMEM);
    memcpy(part, path, length + 1);
    bool good = true;
    for (size_t i = 1; i < length && good; i++) {
        if (part[i] != '/')
            continue;
        part[i] = 0;
        good = make_one(part, error);
        part[i] = '/';
    }
    free(part);
    return good && make_one(path, error);
}

bool dpl_path_has_extension(const char *path, const char *extension) {
    size_t length = strlen(path);
    size_t tail = strlen(extension);
    if (length < tail)
        return false;
    for (size_t i = 0; i < tail; i++)
        if (tolower((unsigned char)path[length - tail + i]) != extension[i])
            return false;
    return true;
}
